#pragma once

#include <cstdint>
#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Largest number of rows of a joint or a contact point: a rigid connection has six.
inline constexpr int kMaxRows = 6;

/// Stored force of a constraint: seeds friction bounds and warm starts.
struct StoredForce {
  std::uint64_t id = 0;          // of the constraint block
  double lambda[kMaxRows] = {};  // per row [N or N m]
  // Per row, with Newton's forces numerov; 0 if not yet known.
  double rate[kMaxRows] = {};         // of lambda [N/s or N m/s]
  double rate_change[kMaxRows] = {};  // of the rate [N/s^2 or N m/s^2]
  double rate_age = 0.0;              // age of the rate relative to lambda [s]
  // Per row, under the soft drift law, and of a drive: Block::elastic [m, rad]. Of an armature: the
  // rate of its coordinate after the sub-step [m/s, rad/s].
  double elastic[kMaxRows] = {};
  std::int8_t active_set[kMaxRows] = {};  // per bounded row: as Block::active_set
};

/// The last sub-step of a body whose island has its own sub-steps.
struct OwnSubstep {
  double dt_previous = 0.0;  // as Carried::dt_previous [s]
  double r = 0.0;            // as Carried::r, of this body [1/s^2]
};

/// Peak rates of a body in two time windows, so that N does not follow every swing: of the rotation
/// criterion (rotation_bound.hpp), and of r if N is held (held_stiffness.hpp).
struct RatePeak {
  double before = 0.0;  // in the last complete window [1/s^2]
  double now = 0.0;     // in the current window [1/s^2]
};

/// State carried from one sub-step to the next besides poses.
struct Carried {
  std::vector<Vec6> u;            // (velocity [m/s], angular velocity [rad/s]), world
  double dt_previous = 0.0;       // length of the last sub-step, 0 at the start [s]
  double r = 0.0;                 // largest k_i/M_ii, Eq. 9 [1/s^2]
  std::vector<Vec6> k;            // diagonal of K per body, Eq. 4 [N/m, N m/rad], or empty
  std::vector<Mat3> K_resisting;  // per body, of mode stiffness: full_stiffness.hpp, or empty
  bool stiffness_known = false;   // r and k are from the last frame; if false, a probe is due
  std::vector<StoredForce> forces;
  // Per body, with Newton's forces numerov: of the last sub-step, 0 after an impact [m/s^2,
  // rad/s^2].
  std::vector<Vec6> acceleration;
  // Per body, if follows_accelerations(), which carries both: change per sub-step of the last
  // length, 0 if unknown [m/s^2, rad/s^2].
  std::vector<Vec6> acceleration_change;
  // Per body with unequal moments of inertia, world [N m]: torque of the last sub-step, 0 if it
  // rotates about a principal axis or after an impact; and if follows_accelerations(), its change,
  // as for the acceleration. Empty without the gyroscopic effect.
  std::vector<Vec3> torque;
  std::vector<Vec3> torque_change;
  std::vector<OwnSubstep> own;     // per body; empty: dt_previous holds for all bodies
  std::vector<RatePeak> rotation;  // per body; empty: the criterion has no memory
  double rotation_age = 0.0;       // age of the current window [s]
  std::vector<RatePeak> held;      // per body, of r; empty: N is not held
  int held_frames = 0;             // in the current window
  std::vector<double> rest;        // per body: time at low speed [s]; empty: not tracked

  /// The last sub-step of a body [s].
  [[nodiscard]] double dt_previous_of(std::size_t body) const {
    return own.empty() ? dt_previous : own[body].dt_previous;
  }
};

}  // namespace substep
