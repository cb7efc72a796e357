#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/model/settings.hpp"
#include "core/model/state.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {

// An N that follows r up and down gains or loses energy at every change, in step with the motion:
// these accumulate with any integrator. With Settings::hold, N rises at once, and falls after hold
// to 2 hold frames that need fewer sub-steps: it follows the largest r of a body in the current
// window of that many frames and in the one before.

/// The largest r of these bodies in both windows [1/s^2].
inline double held_stiffness(const State& state, std::span<const int> bodies) {
  double most = 0.0;
  if (state.held.empty()) return most;
  for (const int body : bodies) {
    const RatePeak& peak = state.held[index(body)];
    most = std::max({most, peak.before, peak.now});
  }
  return most;
}

/// Stores the largest r of the frame that has ended; forgets all if N is not held. @param r per
/// body [1/s^2]
inline void hold_stiffness(const Settings& settings, std::span<const double> r, State& state) {
  if (settings.hold == 1 || !chooses_substeps(settings.mode)) {
    state.held.clear();
    state.held_frames = 0;
    return;
  }
  state.held.resize(r.size());
  const bool shift = state.held_frames >= settings.hold;
  state.held_frames = shift ? 1 : state.held_frames + 1;
  for (std::size_t i = 0; i < r.size(); ++i) {
    RatePeak& peak = state.held[i];
    if (shift) peak = {peak.now, 0.0};
    peak.now = std::max(peak.now, r[i]);
  }
}

}  // namespace substep
