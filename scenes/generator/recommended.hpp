#pragma once
// What is recommended for the shipped scenes, and within which error.

#include <map>
#include <string>
#include <string_view>

#include "core/model/problem.hpp"
#include "core/model/recommended.hpp"
#include "core/model/scene.hpp"

namespace substep::scenes {

/// The error that is wanted of a shipped scene.
struct Wanted {
  const char* scene;
  ErrorAxis of;
  double within;   // [m, J]
  double seconds;  // that the runs to choose from take [s]
};

/// Of a scene, or null where there is nothing to choose.
const Wanted* wanted_of(std::string_view scene);

/// What recommended.json has, by the scenes' names. `substep recommend --all` writes that file.
std::map<std::string, Recommended> recommendations(Problems& problems);

/// The scene with what is recommended for it. Those that show the paper start as it does; the
/// others with what is recommended, unless they have settings of their own.
Scene recommending(Scene scene, const Recommended& recommended);

}  // namespace substep::scenes
