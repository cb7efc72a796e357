#pragma once

#include <algorithm>

#include "core/model/methods.hpp"
#include "core/model/settings.hpp"

namespace substep {

// Small steps (Macklin et al. 2019, "Small steps in physics simulation"): a frame's sweeps are
// distributed over sub-steps of a few sweeps each, and contacts are detected once per frame. The
// error of an unsolved constraint falls with dt^2, but only slowly with the number of sweeps. The
// method combines Settings::share_iterations with Settings::detection = kFrame
// (constraints/contact_stage.hpp).

/// Sweeps of a sub-step. Newton steps are not shared.
/// @param share dt over frame length, in (0, 1]
inline int iterations_of(const Settings& settings, double share) {
  if (!settings.share_iterations || !entry_of(settings.solver).sweeps) return settings.iterations;
  return std::max(1, static_cast<int>(settings.iterations * share + 0.5));
}

}  // namespace substep
