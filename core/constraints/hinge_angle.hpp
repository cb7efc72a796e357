#pragma once

#include "core/constraints/hinge_joint.hpp"
#include "core/math/angle.hpp"

namespace substep {

// theta        = angle about u from v1 to w
// d(theta)/dt  = u . (omega_a - omega_b)
// with u and w fixed in a, v1 fixed in b. The second holds where the hinge does: u . v1 = 0.

/// The angle of a hinge as one row: phi = theta - lower [rad]. For the upper bound u is reversed,
/// which reverses the angle. The functions are documented in PoseRows.
struct HingeAngle {
  using Owner = HingeJoint;

  /// The measure of tolerances [rad].
  static double width(const Body& /*a*/) { return 0.1; }

  /// @param upper whether phi is the distance from the upper bound
  static JointGeometry geometry(const HingeJoint& hinge, const AngleLimit& limit, bool upper) {
    const double sign = upper ? -1.0 : 1.0;
    JointGeometry geometry;
    geometry.u = sign * hinge.axis_a;
    geometry.v1 = limit.across_b;
    geometry.w = limit.across_a;
    geometry.middle = sign * 0.5 * (limit.lower + limit.upper);
    geometry.half_range = 0.5 * (limit.upper - limit.lower);
    return geometry;
  }

  /// phi = theta, from -pi to pi.
  static JointGeometry geometry(const HingeJoint& hinge, const AngleZero& zero) {
    JointGeometry geometry;
    geometry.u = hinge.axis_a;
    geometry.v1 = zero.across_b;
    geometry.w = zero.across_a;
    return geometry;
  }

  /// Of a row that has a speed and no position: the zero of the angle does not matter.
  static JointGeometry geometry(const HingeJoint& hinge) {
    JointGeometry geometry;
    Vec3 other;
    geometry.u = hinge.axis_a;
    across(hinge.axis_a, geometry.w, other);
    across(hinge.axis_b, geometry.v1, other);
    return geometry;
  }

  static void constants(Block& block) {
    block.rows = 1;
    block.position_rows = 0;
    block.has_point_rows = false;
    block.C[0] = 0.0;
    for (int j = 0; j < 3; ++j) block.J_a[0][j] = block.J_b[0][j] = 0.0;
  }

  // Between the bounds, the distance from the middle of the range is less than half a turn.
  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    block.w = a.R * joint.w;
    block.v1 = b.R * joint.v1;
    set_axis(block, a.R * joint.u);
    const double theta = angle_about(block.axis, block.v1, block.w);
    block.phi[0] = wrapped(theta - joint.middle) + joint.half_range;
  }

  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    const Vec3 omega_a = u_a.tail<3>();
    const Vec3 omega_b = u_b.tail<3>();
    curvature[0] = omega_a.cross(block.axis).dot(omega_a - omega_b);
  }

  // The torque on a is l u, that on b its opposite; u rotates with a.
  static void stiffness(const Block& block, auto& K) {
    const Mat3 by_a = -block.lambda[0] * skew(block.axis);
    if (block.a >= 0) K.add_angular(block.a, block.a, by_a);
    if (block.a >= 0 && block.b >= 0) K.add_angular(block.b, block.a, -by_a);
  }

  // In the other order of the bodies u rotates with b.
  static void mean_stiffness(const Block& block, auto& K) {
    const Mat3 mean = -0.5 * block.lambda[0] * skew(block.axis);
    for (const int by : {block.a, block.b}) {
      if (by < 0) continue;
      if (block.a >= 0) K.add_angular(block.a, by, mean);
      if (block.b >= 0) K.add_angular(block.b, by, -mean);
    }
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange /*rows*/,
                   Block& moved) {
    moved.w = a.R * start.w;
    moved.v1 = b.R * start.v1;
    set_axis(moved, a.R * start.axis);
    moved_errors(start, a, b, moved.phi);
  }

  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    const double moved = angle_about(a.R * start.axis, b.R * start.v1, a.R * start.w);
    phi[0] = wrapped(moved - angle_about(start.axis, start.v1, start.w));
  }

  static Vec3 force(const Block& /*block*/, const double* /*force*/) { return Vec3::Zero(); }
  static Vec3 torque(const Block& block, const double* force) { return force[0] * block.axis; }

  static void push_change(const Block& block, const Motion& a, const Motion& /*b*/,
                          const double* force, Vec6& on_a, Vec6& on_b) {
    const Vec3 change = force[0] * (a.R * block.axis - block.axis);
    on_a.tail<3>() += change;
    on_b.tail<3>() -= change;
  }

 private:
  static void set_axis(Block& block, const Vec3& u) {
    block.axis = u;
    for (int j = 0; j < 3; ++j) {
      block.J_a[0][3 + j] = u[j];
      block.J_b[0][3 + j] = -u[j];
    }
  }
};

}  // namespace substep
