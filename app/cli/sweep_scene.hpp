#pragma once

#include <filesystem>

#include "core/model/scene.hpp"

namespace substep::cli {

/// Saves the scene of a sweep beside its results, as scene.json, so that results of different
/// scenes with one name do not mix. @return false, with a message on stderr, if another scene is
/// there, or it cannot be written
bool keep_scene(const std::filesystem::path& folder, const Scene& scene);

}  // namespace substep::cli
