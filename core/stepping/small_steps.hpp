#pragma once

#include <algorithm>

#include "core/model/settings.hpp"

namespace substep {

// Small steps (Macklin et al. 2019, "Small steps in physics simulation"): the sweeps that a frame
// may spend go into sub-steps of a few sweeps each, and contacts are looked for once a frame. The
// argument: what a constraint that is not solved gives way in a sub-step falls with dt^2, what
// sweeps leave of it only slowly with their number. Settings::share_iterations is one half of it;
// the other is Settings::detection, kFrame, in constraints/contact_stage.hpp.

/// Sweeps of a sub-step. What is shared out are sweeps, not Newton's steps.
/// @param share of the frame that the sub-step is, in (0, 1]
inline int iterations_of(const Settings& settings, double share) {
  const bool sweeps = settings.solver == SolverKind::kPgs || settings.solver == SolverKind::kXpbd;
  if (!settings.share_iterations || !sweeps) return settings.iterations;
  return std::max(1, static_cast<int>(settings.iterations * share + 0.5));
}

}  // namespace substep
