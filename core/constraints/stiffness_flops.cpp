#include "core/constraints/stiffness_flops.hpp"

#include "core/constraints/joint_rows.hpp"
#include "core/math/flops.hpp"

namespace substep {
namespace {

constexpr std::int64_t kProduct = product_flops(3, 3, 3);

constexpr std::int64_t kWide = product_flops(3, 3, 6);

std::int64_t normal_flops(std::int64_t bodies) {
  const std::int64_t normal = 2 * kProduct + kSumFlops;                   // N_b, H r
  const std::int64_t torques = 4 * kWide + 2 * kProduct + 5 * kSumFlops;  // by each body
  return normal + torques + bodies * bodies * 2 * 36;                     // scaled, added
}

std::int64_t friction_flops(std::int64_t bodies) {
  const std::int64_t force =
      2 * kProduct + kSumFlops + 9 + 2 * (36 + 18) + 27;          // g, dn, dg by each body
  const std::int64_t arms = 2 * 18 + 3 * kSumFlops;               // dr by each
  return force + arms + bodies * bodies * (2 * kWide + 18 + 36);  // torques, added
}

}  // namespace

std::int64_t stiffness_flops(const Block& block, ContactTerms terms) {
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  if (block.is_contact()) {
    if (terms == ContactTerms::kPaper) {
      return 3 + (block.rows == 3 ? 12 : 0) + BallRows::stiffness_flops(bodies);
    }
    if (block.lambda[0] == 0.0) return 0;
    return normal_flops(bodies) +
           (terms == ContactTerms::kExact && block.rows == 3 ? friction_flops(bodies) : 0);
  }
  std::int64_t flops = 0;
  with_joint_rows(block.kind, [&](auto joint) { flops = joint.stiffness_flops(bodies); });
  return flops;
}

std::int64_t turning_stiffness_flops(const Block& block) {
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  std::int64_t flops = 0;
  if (!block.is_contact()) {
    with_joint_rows(block.kind, [&](auto joint) { flops = joint.turning_stiffness_flops(bodies); });
  } else if (block.lambda[0] != 0.0) {  // H r, its torque and that of n; H rho and n, their torque
    flops = (block.a >= 0 ? 3 * kProduct + 3 * kSumFlops : 0) +
            (block.b >= 0 ? 2 * kProduct + 3 * kSumFlops : 0);
  }
  return flops;
}

}  // namespace substep
