#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

/// Named initial settings.
struct Preset {
  std::string_view name;  // "recommended"
  std::string about;      // for people, in a sentence or two
  Settings settings;
};

/// The paper's settings, the cheapest ones that hold most of the hard scenes, and those that hold
/// all of them.
std::span<const Preset> presets();

/// The same for a scene: "recommended" is the scene's own recommendation, if any.
std::vector<Preset> presets_for(const Scene& scene);

/// By its name, or null.
const Preset* find_preset(std::string_view name);

/// The preset for a scene.
Settings settings_for(const Preset& preset, const Scene& scene);

/// "paper, recommended or robust"
std::string preset_names();

}  // namespace substep
