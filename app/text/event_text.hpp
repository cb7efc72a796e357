#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/run_events.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Maximum size of the events in a link [characters].
inline constexpr std::size_t kMostEventText = 8192;

/// Whether a link to a run of this scene may hold these events. Each ball and each switched effect
/// copies the scene, so the limit is lower for large scenes.
bool fits_link(std::span<const RunEvent> events, const Scene& scene);

/// Lossless URL-safe encoding of events: about 60 characters per ball, 10 per frame of a pull.
/// @param start initial settings of the run
std::string events_text(std::span<const RunEvent> events, const Settings& start);

/// Decodes such text for a run of this scene. @param problem error message, or "" @return the
/// events; none on error
std::vector<RunEvent> read_events(std::string_view text, const Scene& scene, const Settings& start,
                                  std::string& problem);

}  // namespace substep
