#include "core/constraints/stiffness_flops.hpp"

#include "core/math/flops.hpp"

namespace substep {
namespace {

constexpr std::int64_t kProduct = product_flops(3, 3, 3);
constexpr std::int64_t kSkewProduct = 12;
constexpr std::int64_t kSum = 9;

std::int64_t exact_contact_flops(std::int64_t bodies) {
  constexpr std::int64_t kWide = product_flops(3, 3, 6);
  const std::int64_t normal = 2 * kProduct + kSum;                         // N_b, H r
  const std::int64_t force = 12 + 2 * kWide + 27;                          // D, and df by each body
  const std::int64_t arms = 2 * 18 + 3 * kSum;                             // dr by each
  return normal + force + arms + bodies * bodies * (2 * kWide + 18 + 36);  // torques, added
}

}  // namespace

std::int64_t stiffness_flops(const Block& block, bool exact_contact) {
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  const std::int64_t ball = bodies * (kSkewProduct + kSum);
  switch (block.kind) {
    case BlockKind::kBall:
      return ball;
    case BlockKind::kHinge:  // w, W U, on each body and between both
      return ball + 9 + kSkewProduct + bodies * bodies * kSum;
    case BlockKind::kContact:
      if (!exact_contact) return 3 + (block.rows == 3 ? 12 : 0) + ball;
      return block.lambda[0] == 0.0 ? 0 : exact_contact_flops(bodies);
  }
  return 0;
}

}  // namespace substep
