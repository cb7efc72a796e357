#pragma once

#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Force of a joint on its body a, at its anchor, world axes.
struct JointForce {
  Eigen::Vector3f force = Eigen::Vector3f::Zero();   // [N]
  Eigen::Vector3f torque = Eigen::Vector3f::Zero();  // of a hinge's angular rows [N m]
};

/// A contact point and the force in it, world axes.
struct ContactForce {
  int a = -1;                                        // index into Scene::bodies
  int b = -1;                                        // index into Scene::bodies
  Eigen::Vector3f arm_a = Eigen::Vector3f::Zero();   // from the centre of a to the point [m]
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, from b to a
  Eigen::Vector3f force = Eigen::Vector3f::Zero();   // on a, friction included [N]
  float gap = 0.0F;                                  // [m]
};

/// What the constraints did in the last sub-step, for those who draw and list it.
struct ConstraintForces {
  std::vector<JointForce> joints;  // as in Scene::joints; empty before the first sub-step
  std::vector<ContactForce> contacts;
};

}  // namespace substep
