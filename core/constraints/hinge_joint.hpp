#pragma once

#include "core/constraints/ball_joint.hpp"

namespace substep {

/// Two unit vectors across a unit axis, right-handed with it.
void across(const Vec3& axis, Vec3& v1, Vec3& v2);

/// As ball_constants, with rows 3, 4.
void hinge_constants(const HingeJoint& joint, Block& block);

/// Rows 0..2 as the ball joint; rows 3, 4: phi = u . v_k [-], u the axis in a, v_k across the axis
/// in b.
/// @param v1_B, v2_B the vectors across the axis, in the frame of b
void hinge_rows(const HingeJoint& joint, const Vec3& v1_B, const Vec3& v2_B, const Side& a,
                const Side& b, Block& block);

/// As ball_curvature, with rows 3, 4 [1/s^2].
void hinge_curvature(const Block& block, const Vec3& omega_a, const Vec3& omega_b,
                     double* curvature);

void hinge_stiffness(const Block& block, StiffnessMatrix& K);

}  // namespace substep
