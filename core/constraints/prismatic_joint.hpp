#pragma once

#include "core/constraints/hinge_joint.hpp"

namespace substep {

// Let d = x_a + r_a - x_b - r_b be the vector from the anchor on b to that on a, and rho = r_b + d
// the arm from the centre of b to the anchor on a, the point of action on both bodies. With v fixed
// in b:
// C     = v . d
// dC/dt = v . (v_a + omega_a x r_a - v_b) - (rho x v) . omega_b
// so J_a = [ v  r_a x v ],  J_b = -[ v  rho x v ].
//
// Angular rows, with s fixed in a and t in b, as for a hinge:
// C     = s . t
// dC/dt = (s x t) . (omega_a - omega_b)

/// A prismatic joint: rows 0, 1, phi = v_k . d [m], leave the anchor on a free only along the axis;
/// rows 2, 3, phi = u . v_k, and row 4, phi = w . v_2 [-], prevent relative rotation. u, w are the
/// axis and the direction perpendicular to it in a; v_1 is that direction in b and v_2 completes
/// b's axes. The functions are documented in JointRows.
struct PrismaticRows {
  static void constants(const PrismaticJoint& joint, Block& block);
  static JointGeometry geometry(const PrismaticJoint& joint);
  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block);
  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature);

  // The force f = l_1 v_1 + l_2 v_2 on a at r_a, -f on b at rho. It rotates with b:
  //   df = theta_b x f,   dr_a = theta_a x r_a,   drho = dx_a - dx_b + theta_a x r_a
  //   d(r_a x f)  = [f][r_a] theta_a - [r_a][f] theta_b
  //   d(-rho x f) = [f] (dx_a - dx_b - [r_a] theta_a) + [rho][f] theta_b
  static void stiffness(const Block& block, auto& K) {
    const Vec3 f = force(block, block.lambda);
    const Mat3 F = skew(f);
    const Mat3 by_a = angular_stiffness(block);
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
                   Block& moved);
  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi);
  static Vec3 force(const Block& block, const double* force);
  static Vec3 torque(const Block& block, const double* force);
  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b);

 private:
  /// Derivative of the torque on a of the angular rows by the rotation of a: the sum of l [t][s],
  /// as for a hinge.
  static Mat3 angular_stiffness(const Block& block);
};

}  // namespace substep
