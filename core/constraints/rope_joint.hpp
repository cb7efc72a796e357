#pragma once

#include "core/constraints/distance_joint.hpp"

namespace substep {

/// A rope has no rows as a joint, so JointStage appends no block for it; its row is RopeLength. The
/// functions are documented in JointRows.
struct RopeRows : DistanceRows {
  static void constants(const RopeJoint& /*joint*/, Block& block) {
    block.rows = block.position_rows = 0;
    block.has_point_rows = false;
  }

  static JointGeometry geometry(const RopeJoint& joint) { return {joint.anchor_a, joint.anchor_b}; }
};

/// The length of a rope as one row: phi = L - |d| [m], the row of a rod reversed, with n from the
/// anchor on a to that on b. The functions are documented in PoseRows.
struct RopeLength {
  using Owner = RopeJoint;

  /// The measure of tolerances [m]: the half width of body a.
  static double width(const Body& a) {
    return std::visit([](const auto& shape) { return shape.half_width(); }, a.shape);
  }

  static JointGeometry geometry(const RopeJoint& rope, const Limit& limit, bool /*upper*/) {
    JointGeometry geometry{rope.anchor_a, rope.anchor_b};
    geometry.length = limit.upper;
    return geometry;
  }

  static void constants(Block& block) {
    block.rows = block.position_rows = 1;
    block.has_point_rows = false;
    block.C[0] = 0.0;
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    DistanceRows::rows(joint, a, b, block);
    reverse(block);
  }

  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    DistanceRows::curvature(rod(block), u_a, u_b, curvature);
    curvature[0] = -curvature[0];
  }

  static void stiffness(const Block& block, auto& K) { DistanceRows::stiffness(rod(block), K); }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                   Block& moved) {
    DistanceRows::move(start, a, b, rows, moved);
    reverse(moved);
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    DistanceRows::moved_errors(start, a, b, phi);
    phi[0] = -phi[0];
  }

  static Vec3 force(const Block& block, const double* force) { return force[0] * block.n; }
  static Vec3 torque(const Block&, const double*) { return Vec3::Zero(); }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    const double of_rod[1] = {-force[0]};
    DistanceRows::push_change(rod(block), a, b, of_rod, on_a, on_b);
  }

 private:
  static void reverse(Block& block) {
    block.phi[0] = -block.phi[0];
    block.n = -block.n;
    set_row(block, 0, block.n);
  }
  /// The block of a rod with the same force.
  static Block rod(const Block& block) {
    Block rod = block;
    rod.phi[0] = -block.phi[0];
    rod.n = -block.n;
    rod.lambda[0] = -block.lambda[0];
    return rod;
  }
};

}  // namespace substep
