#pragma once
// Consistency of a scene's joints with its poses and velocities.

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"

namespace substep {

class JointStage;

/// Initial-state errors that exceed the tolerance.
struct StartFaults {
  bool gap = false;
  bool tilt = false;
  bool speed = false;
  bool turning = false;

  [[nodiscard]] bool poses() const { return gap || tilt; }
  [[nodiscard]] bool velocities() const { return speed || turning; }
  [[nodiscard]] bool any() const { return poses() || velocities(); }
};

/// Errors of one joint in a state. Only rigid rows count: see holding_rows().
struct JointStart {
  double gap = 0.0;      // distance of the anchors [m]
  double tilt = 0.0;     // angle between the two axes of a hinge [rad]
  double speed = 0.0;    // relative velocity of the anchors [m/s]
  double turning = 0.0;  // relative angular velocity across a hinge's axis [rad/s]
  StartFaults beyond;    // tolerance
};

/// Errors of all joints of a scene, in the order of Scene::joints; empty without the effect
/// `joints`.
///
/// Tolerances: a gap of 1e-9 of the joint's size (its arms and the radius of body a), a tilt of
/// 1e-9 rad, and the rounding error far from the origin. Relative velocities of 1e-9 of that size
/// and of a radian in a frame, plus 1e-9 of the local velocities.
std::vector<JointStart> joint_starts(const Scene& scene, const State& state);

/// Tells the stage which rows are springs, by holding_rows() at a state.
void mark_springs(const Scene& scene, const State& state, JointStage& joints);

/// The largest errors over all joints, with the joint's index into Scene::joints (-1: none).
struct StartErrors {
  double gap = 0.0;  // [m]
  int gap_joint = -1;
  double tilt = 0.0;  // [rad]
  int tilt_joint = -1;
  double speed = 0.0;  // [m/s]
  int speed_joint = -1;
  double turning = 0.0;  // [rad/s]
  int turning_joint = -1;
  StartFaults beyond;  // tolerance, in any joint

  [[nodiscard]] bool consistent() const { return !beyond.any(); }
};
StartErrors start_errors(const Scene& scene, const State& state);

/// Rows of one joint that act as rigid constraints, not as springs.
struct HoldingRows {
  bool anchors = true;  // the three rows of the anchors
  bool axes = true;     // the two rows of a hinge's axes; false for a ball joint
};

/// Rows act as a spring if a frame h resolves their oscillation, C >= h^2 J M^-1 J^T in the mean of
/// the rows: the stretch is then part of the motion, not an initial error. Stiffer rows model an
/// exact joint.
HoldingRows holding_rows(const Block& block, std::span<const InverseMass> inverse_mass, double h);

}  // namespace substep
