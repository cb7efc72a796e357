#pragma once
// Recommended settings of the shipped scenes, and their error limits.

#include <map>
#include <string>
#include <string_view>

#include "core/model/problem.hpp"
#include "core/model/recommended.hpp"
#include "core/model/scene.hpp"

namespace substep::scenes {

/// The error limit of a shipped scene.
struct Wanted {
  const char* scene;
  ErrorAxis of;
  double within;   // [m, J]
  double seconds;  // duration of the compared runs [s]
};

/// The limit of a scene, or null if there is nothing to choose.
const Wanted* wanted_of(std::string_view scene);

/// The content of recommended.json, by scene name. `substep recommend --all` writes that file.
std::map<std::string, Recommended> recommendations(Problems& problems);

/// The scene with its recommended settings. Scenes of the paper start with the paper's settings,
/// the others with the recommended ones unless they have their own.
Scene recommending(Scene scene, const Recommended& recommended);

}  // namespace substep::scenes
