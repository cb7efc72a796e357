#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/model/settings.hpp"

namespace substep {

/// Settings with a name, to begin with.
struct Preset {
  std::string_view name;   // "recommended"
  std::string_view about;  // for people, in a sentence
  Settings settings;
};

/// The paper's settings, those that hold most of the hard set at the least work, and those that
/// hold all of it.
std::span<const Preset> presets();

/// By its name, or null.
const Preset* find_preset(std::string_view name);

/// "paper, recommended or robust"
std::string preset_names();

}  // namespace substep
