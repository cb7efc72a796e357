#pragma once

#include "core/constraints/ball_joint.hpp"

namespace substep {

/// Two unit vectors across a unit axis, right-handed with it.
void across(const Vec3& axis, Vec3& v1, Vec3& v2);

/// Unit vectors of a hinge, in the frames of its bodies.
struct HingeAxes {
  Vec3 u;       // the axis, in the frame of a
  Vec3 v1, v2;  // across the axis, in the frame of b
};
HingeAxes axes_of(const HingeJoint& joint);

/// What a hinge has beyond ball_constants().
void hinge_constants(const HingeJoint& joint, Block& block);

// C     = u . v                        u turns with a, v with b
// dC/dt = (omega_a x u) . v + u . (omega_b x v) = omega_a . (u x v) - omega_b . (u x v)

/// What a hinge has beyond ball_rows(), rows 3, 4: phi = u . v_k [-].
inline void hinge_rows(const HingeAxes& axes, const Side& a, const Side& b, Block& block) {
  const Vec3 u = a.R * axes.u;
  block.axis = u;
  for (int k = 0; k < 2; ++k) {
    const Vec3 v = b.R * (k == 0 ? axes.v1 : axes.v2);
    (k == 0 ? block.v1 : block.v2) = v;
    const Vec3 J = u.cross(v);
    const int row = 3 + k;
    block.phi[row] = u.dot(v);
    for (int j = 0; j < 3; ++j) block.J_a[row][3 + j] = J[j];
  }
}

/// As ball_curvature, with rows 3, 4 [1/s^2].
void hinge_curvature(const Block& block, const Vec3& omega_a, const Vec3& omega_b,
                     double* curvature);

void hinge_stiffness(const Block& block, StiffnessMatrix& K);

}  // namespace substep
