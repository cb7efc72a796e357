#pragma once

#include <filesystem>

#include "core/model/scene.hpp"

namespace substep::cli {

/// Keeps the scene of a sweep beside its results, as scene.json, so that results of two scenes of
/// one name do not mix. @return false and a message on stderr where another scene is there, or it
/// cannot be written
bool keep_scene(const std::filesystem::path& folder, const Scene& scene);

}  // namespace substep::cli
