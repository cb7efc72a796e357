#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/model/scene.hpp"

namespace substep::cli {

/// A scene by the name of a shipped one, by a file's path, or "-" for the standard input. Where it
/// cannot be read, every problem is printed to stderr and the result is null.
std::shared_ptr<const Scene> load_scene(const std::string& name_or_path);

/// Where load_scene() reads it: the file of a shipped scene, else what is given.
std::string scene_path(const std::string& name_or_path);

/// Names of the shipped scenes, in alphabetical order.
std::vector<std::string> shipped_names();

/// Where the shipped scenes are: the environment variable SUBSTEP_SCENES, or the source's folder.
std::string scenes_folder();

}  // namespace substep::cli
