#pragma once
// How well the joints of a scene agree with poses and velocities.

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Which errors of a start are beyond tolerance.
struct StartFaults {
  bool gap = false;
  bool tilt = false;
  bool speed = false;
  bool turning = false;

  [[nodiscard]] bool poses() const { return gap || tilt; }
  [[nodiscard]] bool velocities() const { return speed || turning; }
  [[nodiscard]] bool any() const { return poses() || velocities(); }
};

/// By how much one joint contradicts a state. Only rows that hold count: see holding_rows().
struct JointStart {
  double gap = 0.0;      // distance of the anchors [m]
  double tilt = 0.0;     // angle between the two axes of a hinge [rad]
  double speed = 0.0;    // relative velocity of the anchors [m/s]
  double turning = 0.0;  // relative angular velocity across a hinge's axis [rad/s]
  StartFaults beyond;    // tolerance
};

/// All joints of a scene at a state, as in Scene::joints; empty without the effect `joints`.
///
/// Tolerances: a gap of 1e-9 of the joint's size (its arms and the radius of body a), a tilt of
/// 1e-9 rad, and what rounding leaves far from the origin. Relative velocities of 1e-8 m/s and
/// 1e-8 rad/s, and 1e-9 of the velocities there: runs that are to differ a little start up to
/// 1e-9 m/s apart in each component (`--seed`), and must stay apart.
std::vector<JointStart> joint_starts(const Scene& scene, const State& state);

/// The largest errors over all joints, and whose they are (index into Scene::joints, -1: none).
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

/// Rows of one joint that hold: not those of a spring.
struct HoldingRows {
  bool anchors = true;  // the three that keep the anchors together
  bool axes = true;     // the two that keep the axes of a hinge parallel; false of a ball joint
};

/// Rows with a compliance C that lets their bodies swing more slowly than a frame h resolves,
/// C >= h^2 J M^-1 J^T in the mean of the rows, are a spring: its stretch belongs to the motion
/// and is no error of the start. Stiffer ones stand for an exact joint.
HoldingRows holding_rows(const Block& block, std::span<const InverseMass> inverse_mass, double h);

/// The length that a joint's gap is compared with: both arms and the radius of body a [m].
double size_of_joint(const Scene& scene, const JointBase& joint);

}  // namespace substep
