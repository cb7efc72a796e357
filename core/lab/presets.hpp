#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

/// Settings with a name, to begin with.
struct Preset {
  std::string_view name;  // "recommended"
  std::string about;      // for people, in a sentence or two
  Settings settings;
};

/// The paper's settings, those that hold most of the hard set at the least work, and those that
/// hold all of it.
std::span<const Preset> presets();

/// The same for a scene: "recommended" is what a sweep over it found, where it has that.
std::vector<Preset> presets_for(const Scene& scene);

/// By its name, or null.
const Preset* find_preset(std::string_view name);

/// What a preset is for a scene.
Settings settings_for(const Preset& preset, const Scene& scene);

/// "paper, recommended or robust"
std::string preset_names();

}  // namespace substep
