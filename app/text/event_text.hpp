#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/run_events.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The most that the events of a link may take [characters].
inline constexpr std::size_t kMostEventText = 8192;

/// Whether a link to a run of this scene may hold these events. Each ball and each switched effect
/// makes a copy of the scene: a large one can have few.
bool fits_link(std::span<const RunEvent> events, const Scene& scene);

/// Events as letters that an address can hold, without loss: about 60 for a ball, 10 for each
/// frame of a hand that moves. @param start settings that the run begins with
std::string events_text(std::span<const RunEvent> events, const Settings& start);

/// Reads such text for a run of this scene. @param problem what is wrong with it, or "" @return the
/// events, none where something is wrong
std::vector<RunEvent> read_events(std::string_view text, const Scene& scene, const Settings& start,
                                  std::string& problem);

}  // namespace substep
