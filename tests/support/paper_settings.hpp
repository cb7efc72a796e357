#pragma once
// In tests, settings that are not stated are the paper's: they check its claims, and single methods
// beside the defaults. Tests of the defaults themselves write substep::Settings.

#include "core/model/settings.hpp"

namespace substep::test {

using Settings = PaperSettings;

}  // namespace substep::test
