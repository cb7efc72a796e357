#pragma once

#include <cstdint>

#include "core/math/types.hpp"

namespace substep {

/// One point where body a nearly touches body b. phi is the distance from a's point to b's surface.
struct ContactPoint {
  int a = 0;                    // index into Scene::bodies
  int b = 0;                    // index into Scene::bodies
  std::uint64_t id = 0;         // pair and features: persistent across sub-steps
  Vec3 n = Vec3::UnitY();       // unit, from b to a, world
  double gap = 0.0;             // < 0 when overlapping [m]
  Vec3 point_a = Vec3::Zero();  // on the surface of a, from a's centre, world axes [m]
  Vec3 point_b = Vec3::Zero();  // on the surface of b, from b's centre, world axes [m]
  // The gap is D(p) - radius, D the distance field fixed in b and p a point fixed in a: for a
  // sphere its centre (field_arm = 0), for a corner the corner (field_arm = point_a).
  Vec3 field_arm = Vec3::Zero();  // p from a's centre, world axes [m]
  Mat3 H = Mat3::Zero();          // second derivative of D at p, world axes [1/m]
};

}  // namespace substep
