#pragma once

#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Force of a joint on its body a, world axes. Body b receives the opposite force at the same
/// point.
struct JointForce {
  Vec3 force = Vec3::Zero();   // acts at the anchor on a [N]
  Vec3 torque = Vec3::Zero();  // about that anchor, from a hinge's angular rows [N m]
  double time = 0.0;           // to which it belongs [s]
  bool known = false;          // false if the last sub-step did not solve for it (sleeping bodies)
};

/// A contact point and its force, world axes.
struct ContactForce {
  int a = -1;                  // index into Scene::bodies
  int b = -1;                  // index into Scene::bodies
  Vec3 arm_a = Vec3::Zero();   // from the centre of a to the point [m]
  Vec3 normal = Vec3::Zero();  // unit, from b to a
  Vec3 force = Vec3::Zero();   // on a, friction included [N]
  double gap = 0.0;            // [m]
};

/// Constraint forces of the last sub-step, to the order of the integrator: those at its start,
/// along the rows at its start; with Newton's forces `end` and with XPBD those at its end. With
/// drift laws other than `exact`, the part of Euler's force that turns the velocity (centripetal)
/// is that of the sub-step before. In the first sub-step of bodies that only joints act on, those
/// of the direct solvers are the forces at the start to rounding; with closed contacts, limits,
/// motors or drives they are of first order there, and Euler's lack the centripetal part.
struct ConstraintForces {
  std::vector<JointForce> joints;  // as in Scene::joints; empty before the first sub-step
  std::vector<ContactForce> contacts;
};

}  // namespace substep
