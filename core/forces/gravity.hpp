#pragma once

#include "core/model/scene.hpp"

namespace substep {

/// Uniform gravity. The functions are documented in AppliedForce.
struct Gravity {
  static constexpr bool Effects::*kEffect = &Effects::gravity;

  static void accelerate(const Scene& scene, const Body&, const InertiaInverse&, const Mat3&,
                         double time, Vec6& u) {
    u.head<3>() += time * scene.gravity;
  }
  static double potential(const Scene& scene, const Body& body, const Vec3& x) {
    return -(body.mass * scene.gravity.dot(x));
  }
  static double acceleration_bound(const Scene& scene, const Body&) { return scene.gravity.norm(); }
};

}  // namespace substep
