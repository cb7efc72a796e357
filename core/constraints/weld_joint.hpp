#pragma once

#include "core/constraints/fixed_axes.hpp"

namespace substep {

/// A weld: rows 0..2 of a ball joint, and rows 3..5, which prevent relative rotation. The functions
/// are documented in JointRows.
struct WeldRows {
  using Turn = FixedAxes<3>;

  static void constants(const WeldJoint& joint, Block& block) {
    BallRows::constants(joint, block);
    block.rows = 6;
    Turn::constants(joint.angular_compliance, block);
  }

  static JointGeometry geometry(const WeldJoint& joint) {
    JointGeometry geometry{joint.anchor_a, joint.anchor_b};
    Turn::set_geometry(joint, geometry);
    return geometry;
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    BallRows::rows(joint, a, b, block);
    Turn::rows(joint, a, b, block);
    Turn::set_gradients(block);
  }

  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    BallRows::curvature(block, u_a, u_b, curvature);
    Turn::curvature(block, u_a.tail<3>(), u_b.tail<3>(), curvature);
  }

  static void stiffness(const Block& block, auto& K) {
    BallRows::stiffness(block, K);
    const Mat3 by_a = Turn::stiffness(block);
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
    if (!rows.reaches(3, 6)) return;
    Turn::move(start, a, b, moved);
    Turn::moved_errors(start, a, b, moved.phi);
    Turn::set_gradients(moved);
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    BallRows::moved_errors(start, a, b, phi);
    Turn::moved_errors(start, a, b, phi);
  }

  static Vec3 force(const Block& block, const double* force) {
    return BallRows::force(block, force);
  }

  static Vec3 torque(const Block& block, const double* force) { return Turn::torque(block, force); }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    BallRows::push_change(block, a, b, force, on_a, on_b);
    const Vec3 couple = Turn::moved_torque(block, a, b, force) - torque(block, force);
    on_a.tail<3>() += couple;
    on_b.tail<3>() -= couple;
  }

  static void mean_stiffness(const Block& block, auto& K) {
    BallRows::stiffness(block, K);
    add_mean_couple(block, Turn::stiffness(block), K);
  }
};

}  // namespace substep
