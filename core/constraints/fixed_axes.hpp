#pragma once

#include "core/constraints/hinge_joint.hpp"

namespace substep {

// Angular rows, with s fixed in a and t in b, as for a hinge:
// C     = s . t
// dC/dt = (s x t) . (omega_a - omega_b)

/// Three angular rows that prevent relative rotation: phi = u . v_1, u . v_2, w . v_2 [-]. u, w are
/// the axis and the direction perpendicular to it in a; v_1 is that direction in b and v_2
/// completes b's axes. Part of joints with such rows: JointRows documents the functions.
/// @tparam kFirst the first of the rows
template <int kFirst>
struct FixedAxes {
  static constexpr int kRows = 3;

  static void constants(double angular_compliance, Block& block) {
    for (int row = kFirst; row < kFirst + 3; ++row) block.C[row] = angular_compliance;
  }

  /// Sets the axes. @param joint with axis_a, axis_b, across_a and across_b
  static void set_geometry(const auto& joint, JointGeometry& geometry) {
    const auto across_axis = [](const Vec3& axis, const Vec3& v) -> Vec3 {
      return (v - axis * axis.dot(v)).normalized();
    };
    geometry.u = joint.axis_a;
    geometry.w = across_axis(joint.axis_a, joint.across_a);
    geometry.v1 = across_axis(joint.axis_b, joint.across_b);
    geometry.v2 = joint.axis_b.cross(geometry.v1);
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    block.axis = a.R * joint.u;
    block.w = a.R * joint.w;
    block.v1 = b.R * joint.v1;
    block.v2 = b.R * joint.v2;
    block.phi[kFirst] = block.axis.dot(block.v1);
    block.phi[kFirst + 1] = block.axis.dot(block.v2);
    block.phi[kFirst + 2] = block.w.dot(block.v2);
  }

  /// J, from the axes of the block.
  static void set_gradients(Block& block) {
    const Vec3 turn[3] = {block.axis.cross(block.v1), block.axis.cross(block.v2),
                          block.w.cross(block.v2)};
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 6; ++j) {
        block.J_a[kFirst + k][j] = j < 3 ? 0.0 : turn[k][j - 3];
        block.J_b[kFirst + k][j] = -block.J_a[kFirst + k][j];
      }
    }
  }

  static void curvature(const Block& block, const Vec3& omega_a, const Vec3& omega_b,
                        double* curvature) {
    curvature[kFirst] = dot_curvature(block.axis, block.v1, omega_a, omega_b);
    curvature[kFirst + 1] = dot_curvature(block.axis, block.v2, omega_a, omega_b);
    curvature[kFirst + 2] = dot_curvature(block.w, block.v2, omega_a, omega_b);
  }

  /// Derivative of the torque on a by the rotation of a: the sum of l [t][s], as for a hinge. By
  /// that of b it is minus the transpose.
  static Mat3 stiffness(const Block& block) {
    const double* lambda = block.lambda + kFirst;
    const Vec3 across = lambda[0] * block.v1 + lambda[1] * block.v2;
    return skew_product(across, block.axis) + lambda[2] * skew_product(block.v2, block.w);
  }

  /// The axes of a block that has moved.
  static void move(const Block& start, const Motion& a, const Motion& b, Block& moved) {
    moved.axis = a.R * start.axis;
    moved.w = a.R * start.w;
    moved.v1 = b.R * start.v1;
    moved.v2 = b.R * start.v2;
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    const Vec3 axis = a.R * start.axis;
    const Vec3 v2 = b.R * start.v2;
    phi[kFirst] = axis.dot(b.R * start.v1) - start.axis.dot(start.v1);
    phi[kFirst + 1] = axis.dot(v2) - start.axis.dot(start.v2);
    phi[kFirst + 2] = (a.R * start.w).dot(v2) - start.w.dot(start.v2);
  }

  /// Sets the forces with which the rows exert a torque on a, with w along v_1.
  static void set_couple(const Vec3& couple, Block& block) {
    block.w = block.v1;
    block.lambda[kFirst] = couple.dot(block.v2);
    block.lambda[kFirst + 1] = -couple.dot(block.v1);
    block.lambda[kFirst + 2] = couple.dot(block.axis);
  }

  static Vec3 torque(const Block& block, const double* force) {
    return block.axis.cross(force[kFirst] * block.v1 + force[kFirst + 1] * block.v2) +
           force[kFirst + 2] * block.w.cross(block.v2);
  }

  /// The same with the axes moved.
  static Vec3 moved_torque(const Block& block, const Motion& a, const Motion& b,
                           const double* force) {
    const Vec3 across = force[kFirst] * block.v1 + force[kFirst + 1] * block.v2;
    return (a.R * block.axis).cross(b.R * across) +
           force[kFirst + 2] * (a.R * block.w).cross(b.R * block.v2);
  }
};

}  // namespace substep
