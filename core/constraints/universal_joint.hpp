#pragma once

#include "core/constraints/hinge_joint.hpp"

namespace substep {

/// A universal joint: rows 0..2 of a ball joint, and row 3, phi = u . v [-], which keeps the axis u
/// of a perpendicular to the axis v of b. It is one of a hinge's angular rows. In the other order
/// of the bodies it is the same row, so K has no order. The functions are documented in JointRows.
struct UniversalRows {
  static void constants(const UniversalJoint& joint, Block& block) {
    BallRows::constants(joint, block);
    block.rows = 4;
    block.C[3] = joint.angular_compliance;
    for (int j = 0; j < 3; ++j) block.J_a[3][j] = 0.0;
  }

  static JointGeometry geometry(const UniversalJoint& joint) {
    return {joint.anchor_a, joint.anchor_b, joint.axis_a, joint.axis_b};
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    BallRows::rows(joint, a, b, block);
    set_axes(block, a.R * joint.u, b.R * joint.v1);
    block.phi[3] = block.axis.dot(block.v1);
  }

  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    BallRows::curvature(block, u_a, u_b, curvature);
    curvature[3] = dot_curvature(block.axis, block.v1, u_a.tail<3>(), u_b.tail<3>());
  }

  // Torque on a: l u x v, on b its opposite. By the rotation of a: l (theta x u) x v =
  // l [v][u] theta. By that of b: l u x (theta x v) = -l [u][v] theta.
  static void stiffness(const Block& block, auto& K) {
    BallRows::stiffness(block, K);
    const Mat3 by_a = block.lambda[3] * skew_product(block.v1, block.axis);
    const Mat3 by_b = by_a.transpose();
    if (block.a >= 0) K.add_angular(block.a, block.a, by_a);
    if (block.b >= 0) K.add_angular(block.b, block.b, by_b);
    if (block.a >= 0 && block.b >= 0) {
      K.add_angular(block.a, block.b, -by_b);
      K.add_angular(block.b, block.a, -by_a);
    }
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                   Block& moved) {
    BallRows::move(start, a, b, rows, moved);
    if (!rows.reaches(3, 4)) return;
    set_axes(moved, a.R * start.axis, b.R * start.v1);
    moved.phi[3] = moved.axis.dot(moved.v1) - start.axis.dot(start.v1);
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    BallRows::moved_errors(start, a, b, phi);
    phi[3] = (a.R * start.axis).dot(b.R * start.v1) - start.axis.dot(start.v1);
  }

  static Vec3 force(const Block& block, const double* force) {
    return BallRows::force(block, force);
  }

  static Vec3 torque(const Block& block, const double* force) {
    return force[3] * block.axis.cross(block.v1);
  }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    BallRows::push_change(block, a, b, force, on_a, on_b);
    const Vec3 couple =
        force[3] * ((a.R * block.axis).cross(b.R * block.v1) - block.axis.cross(block.v1));
    on_a.tail<3>() += couple;
    on_b.tail<3>() -= couple;
  }

 private:
  /// Sets the axes of a block, and J of its angular row.
  static void set_axes(Block& block, const Vec3& u, const Vec3& v) {
    block.axis = u;
    block.v1 = v;
    const Vec3 J = u.cross(v);
    for (int j = 0; j < 3; ++j) block.J_a[3][3 + j] = J[j];
  }
};

}  // namespace substep
