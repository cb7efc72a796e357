#include "core/constraints/hinge_joint.hpp"

#include "core/math/across.hpp"

namespace substep {

// (s . t)'' = s'' . t + 2 s' . t' + s . t''
double dot_curvature(const Vec3& s, const Vec3& t, const Vec3& omega_a, const Vec3& omega_b) {
  const Vec3 s_dot = omega_a.cross(s);
  const Vec3 t_dot = omega_b.cross(t);
  return omega_a.cross(s_dot).dot(t) + 2.0 * s_dot.dot(t_dot) + s.dot(omega_b.cross(t_dot));
}

void HingeRows::constants(const HingeJoint& joint, Block& block) {
  BallRows::constants(joint, block);
  block.rows = 5;
  for (int row = 3; row < 5; ++row) {
    block.C[row] = joint.angular_compliance;
    for (int j = 0; j < 3; ++j) block.J_a[row][j] = 0.0;
  }
}

JointGeometry HingeRows::geometry(const HingeJoint& joint) {
  JointGeometry geometry{joint.anchor_a, joint.anchor_b, joint.axis_a};
  across(joint.axis_b, geometry.v1, geometry.v2);
  return geometry;
}

void HingeRows::curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
  BallRows::curvature(block, u_a, u_b, curvature);
  const Vec3 omega_a = u_a.tail<3>();
  const Vec3 omega_b = u_b.tail<3>();
  curvature[3] = dot_curvature(block.axis, block.v1, omega_a, omega_b);
  curvature[4] = dot_curvature(block.axis, block.v2, omega_a, omega_b);
}

void HingeRows::move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                     Block& moved) {
  BallRows::move(start, a, b, rows, moved);
  if (!rows.reaches(3, 5)) return;
  set_axes(moved, a.R * start.axis, b.R * start.v1, b.R * start.v2);
  moved.phi[3] -= start.axis.dot(start.v1);
  moved.phi[4] -= start.axis.dot(start.v2);
}

void HingeRows::moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
  BallRows::moved_errors(start, a, b, phi);
  const Vec3 axis = a.R * start.axis;
  phi[3] = axis.dot(b.R * start.v1) - start.axis.dot(start.v1);
  phi[4] = axis.dot(b.R * start.v2) - start.axis.dot(start.v2);
}

Vec3 HingeRows::torque(const Block& block, const double* force) {
  return force[3] * block.axis.cross(block.v1) + force[4] * block.axis.cross(block.v2);
}

void HingeRows::push_change(const Block& block, const Motion& a, const Motion& b,
                            const double* force, Vec6& on_a, Vec6& on_b) {
  const Vec3 f{force[0], force[1], force[2]};
  const Vec3 w = force[3] * block.v1 + force[4] * block.v2;
  const Vec3 couple = (a.R * block.axis).cross(b.R * w) - block.axis.cross(w);
  on_a.tail<3>() += (a.R * block.r_a - block.r_a).cross(f) + couple;
  on_b.tail<3>() -= (b.R * block.r_b - block.r_b).cross(f) + couple;
}

}  // namespace substep
