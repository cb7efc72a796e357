#include "core/constraints/ball_joint.hpp"

namespace substep {

void ball_constants(const JointBase& joint, Block& block) {
  block.kind = BlockKind::kBall;
  block.rows = 3;
  block.pinned = true;
  for (std::int8_t& tight : block.tight) tight = 0;  // no row is ever let go of
  for (int i = 0; i < 3; ++i) block.C[i] = joint.compliance;
}

// An arm r that turns with omega: r'' = omega x (omega x r).
void ball_curvature(const Block& block, const Vec3& omega_a, const Vec3& omega_b,
                    double* curvature) {
  const Vec3 c = omega_a.cross(omega_a.cross(block.r_a)) - omega_b.cross(omega_b.cross(block.r_b));
  for (int i = 0; i < 3; ++i) curvature[i] = c[i];
}

// The force l acts on a at r_a. Turning a by theta moves the arm by theta x r_a, so the torque
// r_a x l changes by (theta x r_a) x l = l x (r_a x theta) = [l][r_a] theta.
void ball_stiffness(const Block& block, StiffnessMatrix& K) {
  const Vec3 l{block.lambda[0], block.lambda[1], block.lambda[2]};
  if (block.a >= 0) K.add_angular(block.a, block.a, skew_product(l, block.r_a));
  if (block.b >= 0) K.add_angular(block.b, block.b, -skew_product(l, block.r_b));
}

}  // namespace substep
