#pragma once

#include <algorithm>

#include "core/constraints/block.hpp"
#include "core/constraints/joint_geometry.hpp"
#include "core/math/types.hpp"
#include "core/model/joint.hpp"

namespace substep {

// Let d = x_a + r_a - x_b - r_b be the vector from the anchor on b to that on a, and n = d/|d|.
// C     = |d| - L
// dC/dt = n . (v_a + omega_a x r_a - v_b - omega_b x r_b)
// so J_a = [ n  r_a x n ],  J_b = -[ n  r_b x n ].

/// A rod without mass between two points: one row, phi = |d| - L [m]. With compliance it is a
/// spring of free length L. The functions are documented in JointRows.
struct DistanceRows {
  static void constants(const DistanceJoint& joint, Block& block) {
    block.rows = block.position_rows = 1;
    block.has_point_rows = false;
    std::fill_n(block.active_set, kMaxRows, std::int8_t{0});  // rows of joints have no bounds
    block.C[0] = joint.compliance;
  }

  static JointGeometry geometry(const DistanceJoint& joint) {
    JointGeometry geometry{joint.anchor_a, joint.anchor_b};
    geometry.length = joint.length;
    return geometry;
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    block.r_a = a.R * joint.anchor_a;
    block.r_b = b.R * joint.anchor_b;
    block.rho = (a.x - b.x) + (block.r_a - block.r_b);
    block.phi[0] = block.rho.norm() - joint.length;
    set_direction(block);
  }

  // |d|'' = n . d'' + (d'^2 - (n . d')^2)/|d|,   r'' = omega x (omega x r)
  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    const Vec3 omega_a = u_a.tail<3>();
    const Vec3 omega_b = u_b.tail<3>();
    const Vec3 turning_a = omega_a.cross(block.r_a);
    const Vec3 turning_b = omega_b.cross(block.r_b);
    const Vec3 d_dot = (u_a - u_b).head<3>() + (turning_a - turning_b);
    const Vec3 d_ddot = omega_a.cross(turning_a) - omega_b.cross(turning_b);
    const Vec3 across = d_dot - block.n * block.n.dot(d_dot);
    curvature[0] = block.n.dot(d_ddot) + across.squaredNorm() / length_of(block);
  }

  // The force f = l n on a at r_a, -f on b at r_b. With P = (E - n n^T)/|d|,
  //   df = l P dd,   dd = S_a dq_a + S_b dq_b,   S_a = [ E  -[r_a] ],   S_b = -[ E  -[r_b] ]
  //   d(J_a^T l) = S_a^T df + [0  f x (r_a x theta_a)],   likewise for b with -f.
  static void stiffness(const Block& block, auto& K) {
    const Vec3 f = block.lambda[0] * block.n;
    const Mat3 lP =
        block.lambda[0] / length_of(block) * (Mat3::Identity() - block.n * block.n.transpose());
    using Derivative = Eigen::Matrix<double, 3, 6>;
    Derivative S_a = Derivative::Zero();
    Derivative S_b = Derivative::Zero();
    S_a << Mat3::Identity(), -skew(block.r_a);
    S_b << -Mat3::Identity(), skew(block.r_b);
    const auto add = [&](int row, int col, const Derivative& S_row, const Derivative& S_col) {
      if (row >= 0 && col >= 0) K.add(row, col, S_row.transpose() * lP * S_col);
    };
    add(block.a, block.a, S_a, S_a);
    add(block.b, block.b, S_b, S_b);
    add(block.a, block.b, S_a, S_b);
    add(block.b, block.a, S_b, S_a);
    if (block.a >= 0) K.add_angular(block.a, block.a, skew_product(f, block.r_a));
    if (block.b >= 0) K.add_angular(block.b, block.b, -skew_product(f, block.r_b));
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange /*all*/,
                   Block& moved) {
    moved_errors(start, a, b, moved.phi);
    moved.rho = moved_distance(start, a, b);
    moved.r_a = a.R * start.r_a;
    moved.r_b = b.R * start.r_b;
    set_direction(moved);
  }

  // |d + e| - |d| = e . (2 d + e)/(|d + e| + |d|)
  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    const Vec3 moved = moved_distance(start, a, b);
    const double sum = moved.norm() + start.rho.norm();
    phi[0] = sum > 0.0 ? (moved - start.rho).dot(moved + start.rho) / sum : 0.0;
  }

  static Vec3 force(const Block& block, const double* force) { return force[0] * block.n; }
  static Vec3 torque(const Block&, const double*) { return Vec3::Zero(); }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    const Vec3 f = force[0] * block.n;
    const Vec3 f_moved = force[0] * direction_of(moved_distance(block, a, b));
    on_a.head<3>() += f_moved - f;
    on_a.tail<3>() += (a.R * block.r_a).cross(f_moved) - block.r_a.cross(f);
    on_b.head<3>() -= f_moved - f;
    on_b.tail<3>() -= (b.R * block.r_b).cross(f_moved) - block.r_b.cross(f);
  }

 private:
  static Vec3 moved_distance(const Block& start, const Motion& a, const Motion& b) {
    return start.rho +
           ((a.dx - b.dx) + ((a.R * start.r_a - start.r_a) - (b.R * start.r_b - start.r_b)));
  }

  /// Any direction if the anchors coincide, which only a spring allows.
  static Vec3 direction_of(const Vec3& d) {
    const double length = d.norm();
    return length > 0.0 ? Vec3(d / length) : Vec3::UnitX();
  }

  /// |d|, at least a tiny part of L [m].
  static double length_of(const Block& block) {
    const double length = block.rho.norm();
    return std::max(length, 1e-9 * (length - block.phi[0]));
  }

  static void set_direction(Block& block) {
    block.n = direction_of(block.rho);
    set_row(block, 0, block.n);
  }
};

}  // namespace substep
