#pragma once

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// The command line for the same run, from the root of the sources: "./dev cli run bridge --mode
/// const --n 12 --frames 240". Includes the settings that differ from the scene's own; names the
/// scene, or its saved file if it is `own`.
/// @param frames taken by the run; 0: the scene's duration
std::string make_command(const Scene& scene, const Settings& settings, std::int64_t frames,
                         bool own);

}  // namespace substep
