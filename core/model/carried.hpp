#pragma once

#include <cstdint>
#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Force of a constraint that outlives its sub-step: seeds friction bounds and warm starts.
struct StoredForce {
  std::uint64_t id = 0;   // of the constraint block
  double lambda[5] = {};  // per row [N or N m]
  // Per row, where extrapolates(); 0 where it is not known yet.
  double rate[5] = {};         // of lambda [N/s or N m/s]
  double rate_change[5] = {};  // of the rate [N/s^2 or N m/s^2]
  double rate_age = 0.0;       // how long before lambda the rate was so [s]
  double elastic[5] = {};      // per row, of phi under the soft drift law: Block::elastic [m, rad]
  std::int8_t active_set[5] = {};  // per row, of contacts: active set of BPP, as Block::active_set
};

/// The last sub-step of a body whose island has sub-steps of its own.
struct OwnSubstep {
  double dt_previous = 0.0;  // as Carried::dt_previous [s]
  double r = 0.0;            // as Carried::r, of this body [1/s^2]
};

/// How fast a body has rotated, for the rotation criterion: the largest rates of two windows of
/// time, so that N does not follow every swing (rotation_bound.hpp).
struct RotationPeak {
  double before = 0.0;  // in the last whole window [1/s^2]
  double now = 0.0;     // in the present one [1/s^2]
};

/// What a run takes from one sub-step into the next besides poses.
struct Carried {
  std::vector<Vec6> u;            // (velocity [m/s], angular velocity [rad/s]), world
  double dt_previous = 0.0;       // the last sub-step, 0 at the start [s]
  double r = 0.0;                 // largest k_i/M_ii, Eq. 9 [1/s^2]
  std::vector<Vec6> k;            // diagonal of K per body, Eq. 4 [N/m, N m/rad], or empty
  std::vector<Mat3> K_resisting;  // per body, of mode stiffness: full_stiffness.hpp, or empty
  bool stiffness_known = false;   // r and k are of the last frame; where not, a probe is due
  std::vector<StoredForce> forces;
  // Per body, where extrapolates(): of the last sub-step, 0 where something hit [m/s^2, rad/s^2].
  std::vector<Vec6> acceleration;
  // Per body, with follows_accelerations(), which carries both: by how much it changes in a
  // sub-step as long as the last, 0 where that is not known [m/s^2, rad/s^2].
  std::vector<Vec6> acceleration_change;
  // Per body whose moments of inertia differ, world [N m]; 0 where it turns about a principal axis,
  // or something hit: the torque of the last sub-step, and with follows_accelerations() its change
  // as that of the acceleration. Empty without the gyroscopic effect.
  std::vector<Vec3> torque;
  std::vector<Vec3> torque_change;
  std::vector<OwnSubstep> own;         // per body, or empty: dt_previous is that of all bodies
  std::vector<RotationPeak> rotation;  // per body, or empty: the criterion has no memory
  double rotation_age = 0.0;           // of the present window [s]
  std::vector<double> rest;  // per body: how long it has been slow [s]; empty: not looked at

  /// The last sub-step of a body [s].
  [[nodiscard]] double dt_previous_of(std::size_t body) const {
    return own.empty() ? dt_previous : own[body].dt_previous;
  }
};

}  // namespace substep
