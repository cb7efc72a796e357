#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/model/problem.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Either a scene, or every problem of the text at once.
struct SceneResult {
  std::shared_ptr<const Scene> scene;  // null if there are problems
  Problems problems;
};

/// Reads a scene of format version 1 (scenes/scene.schema.json) in parts, to keep a window
/// responsive. Never throws.
class SceneReading {
 public:
  explicit SceneReading(std::string json);
  ~SceneReading();

  /// Does the next part: parses the text, reads a thousand bodies or joints, or checks the scene.
  /// @return true if there is more to do
  bool advance();
  /// Completes the reading. Call once.
  SceneResult result();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a scene in one call.
SceneResult read_scene(std::string_view json);

/// The same from a file; a file that cannot be read is a problem with pointer "".
SceneResult read_scene_file(const std::string& path);

}  // namespace substep
