#pragma once

#include "core/constraints/ball_joint.hpp"
#include "core/math/across.hpp"

namespace substep {

/// d2/dt2 of s . t [1/s^2], where s rotates with a and t with b at constant rates.
/// @param omega_a, omega_b [rad/s]
inline double dot_curvature(const Vec3& s, const Vec3& t, const Vec3& omega_a,
                            const Vec3& omega_b) {
  // (s . t)'' = s'' . t + 2 s' . t' + s . t''
  const Vec3 s_dot = omega_a.cross(s);
  const Vec3 t_dot = omega_b.cross(t);
  return omega_a.cross(s_dot).dot(t) + 2.0 * s_dot.dot(t_dot) + s.dot(omega_b.cross(t_dot));
}

// C     = u . v                        u rotates with a, v with b
// dC/dt = (omega_a x u) . v + u . (omega_b x v) = omega_a . (u x v) - omega_b . (u x v)

/// Adds to K the derivative of a torque on a and its opposite on b, as the mean of both orders of
/// the bodies. @param by_a derivative of the torque on a by the rotation of a; by that of b it is
/// minus the transpose
void add_mean_couple(const Block& block, const Mat3& by_a, auto& K) {
  const Mat3 mean = 0.5 * (by_a - by_a.transpose());
  if (block.a >= 0) K.add_angular(block.a, block.a, mean);
  if (block.b >= 0) K.add_angular(block.b, block.b, -mean);
  if (block.a >= 0 && block.b >= 0) {
    K.add_angular(block.a, block.b, mean);
    K.add_angular(block.b, block.a, -mean);
  }
}

/// A hinge: rows 0..2 of a ball joint, and rows 3, 4, phi = u . v_k [-], which keep the axes
/// parallel. The functions are documented in JointRows.
struct HingeRows {
  static void constants(const HingeJoint& joint, Block& block) {
    BallRows::constants(joint, block);
    block.rows = 5;
    for (int row = 3; row < 5; ++row) {
      block.C[row] = joint.angular_compliance;
      for (int j = 0; j < 3; ++j) block.J_a[row][j] = 0.0;
    }
  }

  static JointGeometry geometry(const HingeJoint& joint) {
    JointGeometry geometry{joint.anchor_a, joint.anchor_b, joint.axis_a};
    across(joint.axis_b, geometry.v1, geometry.v2);
    return geometry;
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    BallRows::rows(joint, a, b, block);
    set_axes(block, a.R * joint.u, b.R * joint.v1, b.R * joint.v2);
  }

  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    BallRows::curvature(block, u_a, u_b, curvature);
    const Vec3 omega_a = u_a.tail<3>();
    const Vec3 omega_b = u_b.tail<3>();
    curvature[3] = dot_curvature(block.axis, block.v1, omega_a, omega_b);
    curvature[4] = dot_curvature(block.axis, block.v2, omega_a, omega_b);
  }

  // Torque on a: l u x v. Rotating a: l (theta x u) x v = l [v][u] theta. Rotating b:
  // l u x (theta x v) = -l [u][v] theta. On b the torque is the opposite. All terms are linear in
  // v, so both rows are combined: w = l_1 v_1 + l_2 v_2.
  static void stiffness(const Block& block, auto& K) {
    BallRows::stiffness(block, K);
    const Vec3 w = block.lambda[3] * block.v1 + block.lambda[4] * block.v2;
    const Mat3 WU = skew_product(w, block.axis);
    const Mat3 UW = WU.transpose();
    if (block.a >= 0) K.add_angular(block.a, block.a, WU);
    if (block.b >= 0) K.add_angular(block.b, block.b, UW);
    if (block.a >= 0 && block.b >= 0) {
      K.add_angular(block.a, block.b, -UW);
      K.add_angular(block.b, block.a, -WU);
    }
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                   Block& moved) {
    BallRows::move(start, a, b, rows, moved);
    if (!rows.reaches(3, 5)) return;
    set_axes(moved, a.R * start.axis, b.R * start.v1, b.R * start.v2);
    moved.phi[3] -= start.axis.dot(start.v1);
    moved.phi[4] -= start.axis.dot(start.v2);
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    BallRows::moved_errors(start, a, b, phi);
    const Vec3 axis = a.R * start.axis;
    phi[3] = axis.dot(b.R * start.v1) - start.axis.dot(start.v1);
    phi[4] = axis.dot(b.R * start.v2) - start.axis.dot(start.v2);
  }

  static Vec3 force(const Block& block, const double* force) {
    return BallRows::force(block, force);
  }

  static Vec3 torque(const Block& block, const double* force) {
    return force[3] * block.axis.cross(block.v1) + force[4] * block.axis.cross(block.v2);
  }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    const Vec3 f{force[0], force[1], force[2]};
    const Vec3 w = force[3] * block.v1 + force[4] * block.v2;
    const Vec3 couple = (a.R * block.axis).cross(b.R * w) - block.axis.cross(w);
    on_a.tail<3>() += (a.R * block.r_a - block.r_a).cross(f) + couple;
    on_b.tail<3>() -= (b.R * block.r_b - block.r_b).cross(f) + couple;
  }

  // The rows in the other order of the bodies have w -> -w: the mean of both blocks of K.
  static void mean_stiffness(const Block& block, auto& K) {
    BallRows::stiffness(block, K);
    const Vec3 w = block.lambda[3] * block.v1 + block.lambda[4] * block.v2;
    add_mean_couple(block, skew_product(w, block.axis), K);
  }

 private:
  /// Sets the axes of a block, and phi and J of its angular rows.
  [[gnu::always_inline]] static void set_axes(Block& block, const Vec3& u, const Vec3& v1,
                                              const Vec3& v2) {
    block.axis = u;
    block.v1 = v1;
    block.v2 = v2;
    for (int k = 0; k < 2; ++k) {
      const Vec3& v = k == 0 ? v1 : v2;
      const Vec3 J = u.cross(v);
      block.phi[3 + k] = u.dot(v);
      for (int j = 0; j < 3; ++j) block.J_a[3 + k][3 + j] = J[j];
    }
  }
};

}  // namespace substep
