#pragma once

#include <string>

#include "core/model/expectation.hpp"

namespace substep::scenes {

/// The verdict table of a shipped scene, by its rules.
Expectations verdicts_of(const std::string& name);

}  // namespace substep::scenes
