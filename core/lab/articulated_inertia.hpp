#pragma once
// Featherstone's articulated-body inertia ("The calculation of robot dynamics using
// articulated-body inertias", 1983) in world axes about the joint point p of each body. With the
// acceleration a of that point and the angular acceleration alpha, the torque and force required on
// the body at p are
//   torque = A alpha + B   a + torque_bias
//   force  = B^T alpha + M a + force_bias.
// For one rigid body with centre p + r, mass m and moments I about the centre, Newton and Euler
// give, with the acceleration of the centre a + alpha x r + omega x (omega x r):
//   A = I - m [r][r],  B = m [r],  M = m E,
//   force_bias = m omega x (omega x r),  torque_bias = omega x I omega + r x force_bias.
// Gravity is represented by an acceleration -g of the world.
//
// The force and torque of a child at its joint, with the free part of alpha eliminated because no
// torque acts there, have the same form; shifted to p they add to the parent's.

#include "core/math/types.hpp"

namespace substep {

struct ArticulatedInertia {
  Mat3 A;            // [kg m^2]
  Mat3 B;            // [kg m]
  Mat3 M;            // [kg]
  Vec3 torque_bias;  // [N m]
  Vec3 force_bias;   // [N]

  /// One body. @param I about its centre, world axes [kg m^2] @param r from p to the centre [m]
  /// @param omega [rad/s]
  static ArticulatedInertia of_body(double mass, const Mat3& I, const Vec3& r, const Vec3& omega);

  [[nodiscard]] Vec3 torque(const Vec3& alpha, const Vec3& a) const {
    return A * alpha + B * a + torque_bias;
  }
  [[nodiscard]] Vec3 force(const Vec3& alpha, const Vec3& a) const {
    return B.transpose() * alpha + M * a + force_bias;
  }

  /// alpha of a ball joint, which transmits no torque: A alpha + B a + torque_bias = 0.
  [[nodiscard]] Vec3 ball_acceleration(const Vec3& a) const;
  /// This with alpha eliminated by a ball joint: M - B^T A^-1 B and its bias remain.
  [[nodiscard]] ArticulatedInertia behind_ball() const;

  /// theta'' of a hinge, alpha = alpha_before + h theta'', which transmits the torque -armature
  /// theta'' along h.
  [[nodiscard]] double hinge_acceleration(const Vec3& h, double armature, const Vec3& alpha_before,
                                          const Vec3& a) const {
    return -h.dot(torque(alpha_before, a)) / (h.dot(A * h) + armature);
  }
  /// This with theta'' eliminated by a hinge, as a function of alpha_before and a.
  /// @param h its axis, unit  @param armature of its angle [kg m^2]
  [[nodiscard]] ArticulatedInertia behind_hinge(const Vec3& h, double armature) const;

  /// alpha and a of a free body: force and torque are zero.
  [[nodiscard]] Vec6 free_acceleration() const;

  /// Adds a child that was eliminated behind its joint.
  /// @param l from p to the child's joint [m] @param alpha_bias, a_bias difference of the child's
  /// alpha_before and a from alpha and a - [l] alpha of this body [rad/s^2, m/s^2]
  void add(const ArticulatedInertia& child, const Vec3& l, const Vec3& alpha_bias,
           const Vec3& a_bias);
};

}  // namespace substep
