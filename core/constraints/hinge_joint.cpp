#include "core/constraints/hinge_joint.hpp"

#include <cmath>

namespace substep {

void across(const Vec3& axis, Vec3& v1, Vec3& v2) {
  const Vec3 helper = std::abs(axis.x()) < 0.8 ? Vec3::UnitX() : Vec3::UnitY();
  v1 = axis.cross(helper).normalized();
  v2 = axis.cross(v1);
}

HingeAxes axes_of(const HingeJoint& joint) {
  HingeAxes axes;
  axes.u = joint.axis_a;
  across(joint.axis_b, axes.v1, axes.v2);
  return axes;
}

void hinge_constants(const HingeJoint& joint, Block& block) {
  block.kind = BlockKind::kHinge;
  block.rows = 5;
  for (int row = 3; row < 5; ++row) {
    block.C[row] = joint.angular_compliance;
    for (int j = 0; j < 3; ++j) block.J_a[row][j] = 0.0;
  }
}

// (u . v)'' = u'' . v + 2 u' . v' + u . v''
void hinge_curvature(const Block& block, const Vec3& omega_a, const Vec3& omega_b,
                     double* curvature) {
  ball_curvature(block, omega_a, omega_b, curvature);
  const Vec3& u = block.axis;
  const Vec3 u_dot = omega_a.cross(u);
  const Vec3 u_ddot = omega_a.cross(u_dot);
  for (int k = 0; k < 2; ++k) {
    const Vec3& v = k == 0 ? block.v1 : block.v2;
    const Vec3 v_dot = omega_b.cross(v);
    curvature[3 + k] = u_ddot.dot(v) + 2.0 * u_dot.dot(v_dot) + u.dot(omega_b.cross(v_dot));
  }
}

// Torque on a: l u x v. Turning a: l (theta x u) x v = l [v][u] theta. Turning b:
// l u x (theta x v) = -l [u][v] theta. On b the torque is the opposite. All of it is linear in v,
// so both rows go together: w = l_1 v_1 + l_2 v_2.
void hinge_stiffness(const Block& block, StiffnessMatrix& K) {
  ball_stiffness(block, K);
  const Vec3 w = block.lambda[3] * block.v1 + block.lambda[4] * block.v2;
  const Mat3 WU = skew_product(w, block.axis);
  const Mat3 UW = WU.transpose();
  if (block.a >= 0) K.add_angular(block.a, block.a, WU);
  if (block.b >= 0) K.add_angular(block.b, block.b, UW);
  if (block.a >= 0 && block.b >= 0) {
    K.add_angular(block.a, block.b, -UW);
    K.add_angular(block.b, block.a, -WU);
  }
}

}  // namespace substep
