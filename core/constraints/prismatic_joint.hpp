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
  static void stiffness(const Block& block, StiffnessMatrix& K);
  static void turning_stiffness(const Block& block, std::span<Mat3> K);
  static void move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                   Block& moved);
  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi);
  static Vec3 force(const Block& block, const double* force);
  static Vec3 torque(const Block& block, const double* force);
  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b);
};

}  // namespace substep
