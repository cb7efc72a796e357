#pragma once

#include <string>
#include <string_view>

#include "core/model/settings.hpp"

namespace substep {

/// A text of methods.hpp with placeholders replaced by settings: "N up to {n_cap}".
std::string with_values(std::string_view text, const Settings& settings);

}  // namespace substep
