#pragma once

#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// The energy that semi-implicit Euler keeps in runs of one constant step (core/docs/energy.md):
/// its kinetic part is u M u'/2, with the velocities of the steps before and after a pose. The true
/// energy of an oscillation of frequency w exceeds it by up to q/(1 - q) of it, q = (w dt/2)^2, at
/// any step below 2/w: an error, but not a growing one. The excess is a M a dt^2/8, with the
/// acceleration a.
///
/// For scenes with rigid joints and without contacts, limits and parts that are implicit.
class ShadowEnergy {
 public:
  /// @param start report of the initial state
  ShadowEnergy(const Scene& scene, const State& state, const FrameReport& start);
  /// True if it applies to a scene.
  static bool applies(const Scene& scene);

  /// After a frame of one step: the report of the frame before it, with the shadow energy.
  FrameReport add(const Scene& scene, const State& state, const FrameReport& report);

  /// True if the excess is larger than that of any stable motion below this limit.
  /// @param share of the limit that the step is [-], below 1
  [[nodiscard]] bool exceeds_stable(double share) const;
  /// The largest excess so far [J].
  [[nodiscard]] double excess() const { return excess_; }

 private:
  std::vector<Vec6> u_;  // of the last step
  std::vector<Quat> q_;  // after it
  FrameReport report_;   // after it
  double excess_ = 0.0;
  double kinetic_ = 0.0;  // largest so far, of the shadow energy [J]
  double noise_ = 0.0;    // [J]
};

}  // namespace substep
