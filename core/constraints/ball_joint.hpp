#pragma once

#include <algorithm>

#include "core/constraints/block.hpp"
#include "core/constraints/joint_geometry.hpp"
#include "core/model/joint.hpp"

namespace substep {

// C    = x_a + r_a - x_b - r_b
// dC/dt = v_a + omega_a x r_a - v_b - omega_b x r_b
// J_a  = [ E  -[r_a] ],  J_b = [ -E  [r_b] ]
// so row i has the linear part e_i and the angular part r_a x e_i: gradient().

/// A ball joint: rows 0..2 keep the anchors together. The functions are documented in JointRows.
struct BallRows {
  /// For any joint that pins two points to each other.
  static void constants(const JointBase& joint, Block& block) {
    block.rows = block.position_rows = 3;
    block.has_point_rows = true;
    std::fill_n(block.active_set, kMaxRows, std::int8_t{0});  // rows of joints have no bounds
    for (int i = 0; i < 3; ++i) block.C[i] = joint.compliance;
  }

  static JointGeometry geometry(const BallJoint& joint) { return {joint.anchor_a, joint.anchor_b}; }

  /// phi = x_a + r_a - x_b - r_b, world axes [m].
  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    const Vec3 r_a = a.R * joint.anchor_a;
    const Vec3 r_b = b.R * joint.anchor_b;
    // Subtract the centres first: the rounding error is then the same far from the origin.
    const Vec3 phi = (a.x - b.x) + (r_a - r_b);
    block.r_a = r_a;
    block.r_b = r_b;
    for (int i = 0; i < 3; ++i) block.phi[i] = phi[i];
  }

  // An arm r rotating with omega: r'' = omega x (omega x r).
  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    const Vec3 omega_a = u_a.tail<3>();
    const Vec3 omega_b = u_b.tail<3>();
    const Vec3 c =
        omega_a.cross(omega_a.cross(block.r_a)) - omega_b.cross(omega_b.cross(block.r_b));
    for (int i = 0; i < 3; ++i) curvature[i] = c[i];
  }

  // The force l acts on a at r_a. Rotating a by theta moves the arm by theta x r_a, so the torque
  // r_a x l changes by (theta x r_a) x l = l x (r_a x theta) = [l][r_a] theta.
  static void stiffness(const Block& block, auto& K) {
    const Vec3 l{block.lambda[0], block.lambda[1], block.lambda[2]};
    if (block.a >= 0) K.add_angular(block.a, block.a, skew_product(l, block.r_a));
    if (block.b >= 0) K.add_angular(block.b, block.b, -skew_product(l, block.r_b));
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                   Block& moved) {
    if (!rows.reaches(0, 3)) return;
    moved.r_a = a.R * start.r_a;
    moved.r_b = b.R * start.r_b;
    const Vec3 phi = (a.dx - b.dx) + ((moved.r_a - start.r_a) - (moved.r_b - start.r_b));
    for (int i = 0; i < 3; ++i) moved.phi[i] = phi[i];
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    const Vec3 r_a = a.R * start.r_a;
    const Vec3 r_b = b.R * start.r_b;
    const Vec3 gap = (a.dx - b.dx) + ((r_a - start.r_a) - (r_b - start.r_b));
    for (int i = 0; i < 3; ++i) phi[i] = gap[i];
  }

  static Vec3 force(const Block&, const double* force) { return {force[0], force[1], force[2]}; }
  static Vec3 torque(const Block&, const double*) { return Vec3::Zero(); }

  // The force is constant, and each arm rotates with its body.
  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    const Vec3 f{force[0], force[1], force[2]};
    on_a.tail<3>() += (a.R * block.r_a - block.r_a).cross(f);
    on_b.tail<3>() -= (b.R * block.r_b - block.r_b).cross(f);
  }
};

}  // namespace substep
