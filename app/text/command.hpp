#pragma once

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// What to type at the root of the sources for the same run:
/// "./dev cli run bridge --mode const --n 12 --frames 240". Settings are there where they differ
/// from the scene's own; the scene is named, or its file where it is `own`, as saving calls it.
/// @param frames that the run has taken; 0 leaves the length to the scene
std::string make_command(const Scene& scene, const Settings& settings, std::int64_t frames,
                         bool own);

}  // namespace substep
