#pragma once

#include <algorithm>
#include <utility>

#include "core/constraints/block.hpp"
#include "core/constraints/joint_geometry.hpp"
#include "core/math/types.hpp"

namespace substep {

// Let d = x_a + r_a - x_b - r_b be the vector from the anchor on b to that on a, and rho = r_b + d
// the arm from the centre of b to the anchor on a, the point of action on both bodies. With v fixed
// in b:
// C     = v . d
// dC/dt = v . (v_a + omega_a x r_a - v_b) - (rho x v) . omega_b
// so J_a = [ v  r_a x v ],  J_b = -[ v  rho x v ].

/// Rows 0, 1, phi = v_k . d [m], which leave the anchor on a free only along the axis, and angular
/// rows from row 2 on. Part of joints with such rows: JointRows documents the functions.
/// @tparam AngularRows the angular rows, such as FixedAxes<2>
template <class AngularRows>
struct SlidingRows {
  using Turn = AngularRows;

  static void constants(const auto& joint, Block& block) {
    block.rows = 2 + Turn::kRows;
    block.position_rows = 2;
    block.has_point_rows = false;
    std::fill_n(block.active_set, kMaxRows, std::int8_t{0});  // rows of joints have no bounds
    std::fill_n(block.C, 2, joint.compliance);
    Turn::constants(joint.angular_compliance, block);
  }

  static JointGeometry geometry(const auto& joint) {
    JointGeometry geometry{joint.anchor_a, joint.anchor_b};
    Turn::set_geometry(joint, geometry);
    return geometry;
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    const Vec3 r_a = a.R * joint.anchor_a;
    const Vec3 d = (a.x - b.x) + (r_a - b.R * joint.anchor_b);
    block.r_a = r_a;
    block.r_b = (a.x - b.x) + r_a;
    block.rho = b.R * joint.anchor_b;
    Turn::rows(joint, a, b, block);
    block.phi[0] = block.v1.dot(d);
    block.phi[1] = block.v2.dot(d);
    set_gradients(block, {});
  }

  // v rotates with b like the anchor on b: v . r_b is constant, and phi = v . rho minus a constant.
  //   (v . rho)'' = v'' . rho + 2 v' . rho' + v . rho'',   rho'' = omega_a x (omega_a x r_a)
  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    const Vec3 omega_a = u_a.tail<3>();
    const Vec3 omega_b = u_b.tail<3>();
    const Vec3 turning = omega_a.cross(block.r_a);
    const Vec3 rho_dot = (u_a - u_b).head<3>() + turning;
    const Vec3 rho_ddot = omega_a.cross(turning);
    for (int k = 0; k < 2; ++k) {
      const Vec3& v = k == 0 ? block.v1 : block.v2;
      const Vec3 v_dot = omega_b.cross(v);
      curvature[k] =
          omega_b.cross(v_dot).dot(block.r_b) + 2.0 * v_dot.dot(rho_dot) + v.dot(rho_ddot);
    }
    Turn::curvature(block, omega_a, omega_b, curvature);
  }

  // The force f = l_1 v_1 + l_2 v_2 on a at r_a, -f on b at rho. It rotates with b:
  //   df = theta_b x f,   dr_a = theta_a x r_a,   drho = dx_a - dx_b + theta_a x r_a
  //   d(r_a x f)  = [f][r_a] theta_a - [r_a][f] theta_b
  //   d(-rho x f) = [f] (dx_a - dx_b - [r_a] theta_a) + [rho][f] theta_b
  static void stiffness(const Block& block, auto& K) {
    const Vec3 f = force(block, block.lambda);
    const Mat3 F = skew(f);
    const Mat3 by_a = Turn::stiffness(block);
    const Mat3 by_b = by_a.transpose();
    if (block.a >= 0) K.add_angular(block.a, block.a, skew_product(f, block.r_a) + by_a);
    if (block.b < 0) return;
    Mat6 part = Mat6::Zero();
    part.topRightCorner<3, 3>() = F;
    part.bottomLeftCorner<3, 3>() = -F;
    part.bottomRightCorner<3, 3>() = skew_product(block.r_b, f) + by_b;
    K.add(block.b, block.b, part);
    if (block.a < 0) return;
    part.bottomLeftCorner<3, 3>().setZero();
    part.topRightCorner<3, 3>() = -F;
    part.bottomRightCorner<3, 3>() = -skew_product(block.r_a, f) - by_b;
    K.add(block.a, block.b, part);
    part.topRightCorner<3, 3>().setZero();
    part.bottomLeftCorner<3, 3>() = F;
    part.bottomRightCorner<3, 3>() = -skew_product(f, block.r_a) - by_a;
    K.add(block.b, block.a, part);
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                   Block& moved) {
    moved_errors(start, a, b, moved.phi);
    moved.r_b = slid_rho(start, a, b);
    moved.r_a = a.R * start.r_a;
    moved.rho = b.R * start.rho;
    Turn::move(start, a, b, moved);
    set_gradients(moved, rows);
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    // In the frame of b, in which v is fixed.
    const Vec3 slid = b.R.transpose() * slid_rho(start, a, b) - start.r_b;
    phi[0] = start.v1.dot(slid);
    phi[1] = start.v2.dot(slid);
    Turn::moved_errors(start, a, b, phi);
  }

  static Vec3 force(const Block& block, const double* force) {
    return force[0] * block.v1 + force[1] * block.v2;
  }

  static Vec3 torque(const Block& block, const double* force) { return Turn::torque(block, force); }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    const Vec3 f = SlidingRows::force(block, force);
    const Vec3 f_moved = b.R * f;
    const Vec3 couple = Turn::moved_torque(block, a, b, force) - torque(block, force);
    const Vec3 turned = (a.R * block.r_a).cross(f_moved) - block.r_a.cross(f) + couple;
    const Vec3 slid = slid_rho(block, a, b).cross(f_moved) - block.r_b.cross(f) + couple;
    on_a.head<3>() += f_moved - f;
    on_a.tail<3>() += turned;
    on_b.head<3>() -= f_moved - f;
    on_b.tail<3>() -= slid;
  }

  static void mean_stiffness(const Block& block, auto& K) {
    Block half = block;
    for (double& lambda : half.lambda) lambda *= 0.5;
    stiffness(half, K);
    stiffness(exchanged(half), K);
  }

  /// The joint with a and b exchanged, with the same forces on the bodies: at the anchor on b, in
  /// directions fixed in a.
  static Block exchanged(const Block& block) {
    const Vec3 d = block.r_b - block.rho;
    const Vec3 couple =
        -(torque(block, block.lambda) + d.cross(force(block, block.lambda)));  // on b
    Block out = block;
    std::swap(out.a, out.b);
    out.r_a = block.rho;
    out.r_b = block.r_a - d;
    out.rho = block.r_a;
    out.lambda[0] = -block.lambda[0];
    out.lambda[1] = -block.lambda[1];
    Turn::set_couple(couple, out);
    return out;
  }

 private:
  /// The arm from the centre of b to the anchor on a after both have moved.
  static Vec3 slid_rho(const Block& start, const Motion& a, const Motion& b) {
    return start.r_b + (a.dx - b.dx) + (a.R * start.r_a - start.r_a);
  }

  /// J of some rows, from the arms and directions of a block.
  static void set_gradients(Block& block, RowRange rows) {
    if (rows.reaches(0, 2)) {
      set_row(block, 0, block.v1);
      set_row(block, 1, block.v2);
    }
    if (rows.reaches(2, 2 + Turn::kRows)) Turn::set_gradients(block);
  }
};

}  // namespace substep
