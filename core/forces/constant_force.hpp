#pragma once

#include "core/model/scene.hpp"

namespace substep {

/// The constant force and torque of a body: effect `external`. The functions are documented in
/// AppliedForce.
struct ConstantForce {
  static constexpr bool Effects::*kEffect = &Effects::external;

  static void accelerate(const Scene&, const Body& body, const InertiaInverse& own,
                         const Mat3& R_WB, double time, Vec6& u) {
    u.head<3>() += time * own.linear * body.force;
    const Vec3 torque_B = R_WB.transpose() * body.torque;
    u.tail<3>() += time * (R_WB * own.angular.cwiseProduct(torque_B));
  }
  /// Without the work of the torque, which has no potential.
  static double potential(const Scene&, const Body& body, const Vec3& x) {
    return -body.force.dot(x);
  }
  static double acceleration_bound(const Scene&, const Body& body) {
    return body.force.norm() / body.mass +
           radius_around(body.shape) * body.torque.norm() / body.inertia.minCoeff();
  }
};

}  // namespace substep
