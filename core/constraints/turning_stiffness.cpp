#include "core/constraints/turning_stiffness.hpp"

namespace substep {
namespace {

// contact_stiffness_normal() has the derivation; N_b is the derivative of n as b turns.
void add_of_contact(const Block& block, std::span<Mat3> K) {
  const double l = block.lambda[0];
  if (l == 0.0) return;
  const Mat3 n = skew(block.n);
  if (block.a >= 0) {
    const Mat3 r = skew(block.arm_a);
    const Mat3 torque = n * r - r * (block.H * r);
    K[index(block.a)] += l * torque;
  }
  if (block.b >= 0) {
    const Mat3 rho = skew(block.rho);
    const Mat3 N_b = block.H * rho - n;
    const Mat3 torque = rho * N_b;
    K[index(block.b)] -= l * torque;
  }
}

}  // namespace

// ball_stiffness() and hinge_stiffness() have the derivations.
void add_turning_stiffness(const Block& block, std::span<Mat3> K) {
  if (block.is_contact()) return add_of_contact(block, K);
  const Vec3 l{block.lambda[0], block.lambda[1], block.lambda[2]};
  if (block.a >= 0) K[index(block.a)] += skew_product(l, block.r_a);
  if (block.b >= 0) K[index(block.b)] -= skew_product(l, block.r_b);
  if (block.kind != BlockKind::kHinge) return;
  const Vec3 w = block.lambda[3] * block.v1 + block.lambda[4] * block.v2;
  const Mat3 WU = skew_product(w, block.axis);
  if (block.a >= 0) K[index(block.a)] += WU;
  if (block.b >= 0) K[index(block.b)] += WU.transpose();
}

}  // namespace substep
