#pragma once

#include "core/constraints/block.hpp"
#include "core/constraints/stiffness_matrix.hpp"
#include "core/model/joint.hpp"
#include "core/model/state.hpp"

namespace substep {

inline const Vec3 kOrigin = Vec3::Zero();
inline const Mat3 kUnturned = Mat3::Identity();

/// World pose of one side of a joint, which has to outlive it. For kWorld: origin, no rotation.
struct Side {
  const Vec3& x = kOrigin;    // centre of mass, world [m]
  const Mat3& R = kUnturned;  // R_WB
};

/// What of a ball joint is the same in every sub-step. It has to be set once.
void ball_constants(const JointBase& joint, Block& block);

// C    = x_a + r_a - x_b - r_b
// dC/dt = v_a + omega_a x r_a - v_b - omega_b x r_b
// J_a  = [ E  -[r_a] ],  J_b = [ -E  [r_b] ]
// so row i has the linear part e_i and the angular part r_a x e_i: gradient().

/// Rows 0..2: phi = x_a + r_a - x_b - r_b, world axes [m].
/// @param anchor_a, anchor_b in the frames of the sides [m]
inline void ball_rows(const Vec3& anchor_a, const Vec3& anchor_b, const Side& a, const Side& b,
                      Block& block) {
  const Vec3 r_a = a.R * anchor_a;
  const Vec3 r_b = b.R * anchor_b;
  // Differences of centres first: near the origin or far from it, the error is the same.
  const Vec3 phi = (a.x - b.x) + (r_a - r_b);
  block.r_a = r_a;
  block.r_b = r_b;
  for (int i = 0; i < 3; ++i) block.phi[i] = phi[i];
}

/// How rows 0..2 curve while both bodies turn on as they do: d2phi/dt2 at constant velocities
/// [m/s^2]. @param omega_a, omega_b world [rad/s], zero for the world  @param curvature out
void ball_curvature(const Block& block, const Vec3& omega_a, const Vec3& omega_b,
                    double* curvature);

/// d(J^T lambda)/dq of rows 0..2 (method: K_aa = [l][r_a], K_bb = -[l][r_b]).
void ball_stiffness(const Block& block, StiffnessMatrix& K);

}  // namespace substep
