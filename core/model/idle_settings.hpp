#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model/settings.hpp"

namespace substep {

/// Why a setting has no effect beside the others: "mode adaptive does not read it, only const".
/// Nothing if it may have one, in a scene that calls for it.
std::optional<std::string> idle_reason(const Settings& settings, std::string_view setting);

}  // namespace substep
