#include "core/constraints/turning_stiffness.hpp"

#include "core/constraints/joint_rows.hpp"

namespace substep {
namespace {

/// In place of a StiffnessMatrix: keeps the angular parts of its diagonal blocks.
struct TurningStiffness {
  std::span<Mat3> K;

  void add_angular(int row, int col, const Mat3& block) const {
    if (row == col) K[index(row)] += block;
  }
  void add(int row, int col, const Mat6& block) const {
    if (row == col) K[index(row)] += block.bottomRightCorner<3, 3>();
  }
};

// contact.cpp has the derivation; N_b is the derivative of n by the rotation of b.
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

void add_turning_stiffness(const Block& block, std::span<Mat3> K) {
  if (block.is_contact()) return add_of_contact(block, K);
  TurningStiffness turning{K};
  with_joint_rows(block.kind, [&](auto joint) { joint.stiffness(block, turning); });
}

}  // namespace substep
