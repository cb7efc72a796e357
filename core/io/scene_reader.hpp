#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

/// One thing wrong with outside data.
struct Problem {
  std::string pointer;  // JSON pointer to the place, "" for the whole document
  std::string message;  // value and allowed range: "-1 is not > 0 (kg)"
};

/// "/bodies/3/mass: -1 is not > 0 (kg)"
std::string to_string(const Problem& problem);

/// Either a scene, or every problem of the text at once.
struct SceneResult {
  std::shared_ptr<const Scene> scene;  // null where there are problems
  std::vector<Problem> problems;
};

/// Reads a scene of format version 1 (scenes/scene.schema.json). Never throws.
SceneResult read_scene(std::string_view json);

/// The same from a file; a file that cannot be read is a problem with pointer "".
SceneResult read_scene_file(const std::string& path);

}  // namespace substep
