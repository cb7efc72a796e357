#pragma once

#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// What a joint exerts on its body a, world axes. Body b gets the opposite, at the same point.
struct JointForce {
  Vec3 force = Vec3::Zero();   // acts at the anchor on a [N]
  Vec3 torque = Vec3::Zero();  // about that anchor: of a hinge's angular rows [N m]
  bool known = false;          // false where the last sub-step did not solve for it: bodies asleep
};

/// A contact point and the force in it, world axes.
struct ContactForce {
  int a = -1;                  // index into Scene::bodies
  int b = -1;                  // index into Scene::bodies
  Vec3 arm_a = Vec3::Zero();   // from the centre of a to the point [m]
  Vec3 normal = Vec3::Zero();  // unit, from b to a
  Vec3 force = Vec3::Zero();   // on a, friction included [N]
  double gap = 0.0;            // [m]
};

/// What the constraints did in the last sub-step: the mean over it, of rows at its start.
struct ConstraintForces {
  std::vector<JointForce> joints;  // as in Scene::joints; empty before the first sub-step
  std::vector<ContactForce> contacts;
};

}  // namespace substep
