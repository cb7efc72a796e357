#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/import/model_files.hpp"
#include "core/model/scene.hpp"

namespace substep::cli {

/// Loads a scene by shipped name or file path; "-" is standard input. On failure prints all
/// problems to stderr and returns null.
std::shared_ptr<const Scene> load_scene(const std::string& name_or_path);

/// The files beside a model, which become inputs that no output replaces.
ModelFiles model_files(const std::filesystem::path& model);

/// The path that load_scene() reads: the file of a shipped scene, or the argument.
std::string scene_path(const std::string& name_or_path);

/// Names of the shipped scenes, in alphabetical order.
std::vector<std::string> shipped_names();

/// The folder of the shipped scenes: the environment variable SUBSTEP_SCENES, or the source's
/// folder.
std::string scenes_folder();

}  // namespace substep::cli
