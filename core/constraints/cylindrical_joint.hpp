#pragma once

#include "core/constraints/hinge_joint.hpp"
#include "core/constraints/sliding_rows.hpp"

namespace substep {

/// Two angular rows, phi = u . v_k [-], which keep the axes parallel like those of a hinge: u is
/// the axis in a, v_k are perpendicular to it in b. Part of joints with such rows: JointRows
/// documents the functions.
/// @tparam kFirst the first of the rows
template <int kFirst>
struct ParallelAxes {
  static constexpr int kRows = 2;

  static void constants(double angular_compliance, Block& block) {
    for (int k = 0; k < 2; ++k) block.C[kFirst + k] = angular_compliance;
  }

  /// Sets the axes. @param joint with axis_a and axis_b
  static void set_geometry(const auto& joint, JointGeometry& geometry) {
    geometry.u = joint.axis_a;
    across(joint.axis_b, geometry.v1, geometry.v2);
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    block.axis = a.R * joint.u;
    block.v1 = b.R * joint.v1;
    block.v2 = b.R * joint.v2;
    block.phi[kFirst] = block.axis.dot(block.v1);
    block.phi[kFirst + 1] = block.axis.dot(block.v2);
  }

  /// J, from the axes of the block.
  static void set_gradients(Block& block) {
    const Vec3 turn[2] = {block.axis.cross(block.v1), block.axis.cross(block.v2)};
    for (int k = 0; k < 2; ++k) {
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
  }

  /// Derivative of the torque on a by the rotation of a, as for a hinge. By that of b it is minus
  /// the transpose.
  static Mat3 stiffness(const Block& block) {
    return skew_product(across_by(block, block.lambda), block.axis);
  }

  /// The axes of a block that has moved.
  static void move(const Block& start, const Motion& a, const Motion& b, Block& moved) {
    moved.axis = a.R * start.axis;
    moved.v1 = b.R * start.v1;
    moved.v2 = b.R * start.v2;
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    const Vec3 axis = a.R * start.axis;
    phi[kFirst] = axis.dot(b.R * start.v1) - start.axis.dot(start.v1);
    phi[kFirst + 1] = axis.dot(b.R * start.v2) - start.axis.dot(start.v2);
  }

  /// Sets the forces with which the rows exert a torque on a; the rows have none about the axis.
  static void set_couple(const Vec3& couple, Block& block) {
    block.lambda[kFirst] = couple.dot(block.v2);
    block.lambda[kFirst + 1] = -couple.dot(block.v1);
  }

  static Vec3 torque(const Block& block, const double* force) {
    return block.axis.cross(across_by(block, force));
  }

  /// The same with the axes moved.
  static Vec3 moved_torque(const Block& block, const Motion& a, const Motion& b,
                           const double* force) {
    return (a.R * block.axis).cross(b.R * across_by(block, force));
  }

 private:
  static Vec3 across_by(const Block& block, const double* force) {
    return force[kFirst] * block.v1 + force[kFirst + 1] * block.v2;
  }
};

/// A cylindrical joint: rows 0, 1 of SlidingRows leave the anchor on a free only along the axis;
/// rows 2, 3 keep the axes parallel.
struct CylindricalRows : SlidingRows<ParallelAxes<2>> {};

}  // namespace substep
