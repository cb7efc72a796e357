#include "core/solver/least_impulses.hpp"

#include <algorithm>

#include "core/solver/cost_model.hpp"

namespace substep {
namespace {

/// A spring that is softer has an impulse of its own, whatever the others have.
bool is_exact(const Block& joint, std::span<const InverseMass> inverse_mass) {
  for (int row = 0; row < joint.rows; ++row) {
    if (joint.softness[row] < SaddleLdlt::kShared * mobility_of(joint, row, inverse_mass)) {
      return true;
    }
  }
  return false;
}

}  // namespace

void LeastImpulses::reserve(std::size_t bodies, std::size_t blocks) {
  ldlt_.reserve(bodies, blocks);
  rows_.reserve(blocks);
  u_.reserve(bodies);
  joined_.reserve(bodies + 1);
}

bool LeastImpulses::has_loop(std::span<const Block> blocks,
                             std::span<const InverseMass> inverse_mass) {
  const auto world = static_cast<int>(inverse_mass.size());
  joined_.reset(inverse_mass.size() + 1);
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    return !block.is_bounded() && is_exact(block, inverse_mass) &&
           !joined_.unite(block.a < 0 ? world : block.a, block.b < 0 ? world : block.b);
  });
}

std::int64_t LeastImpulses::find(const System& system, std::span<const Vec6> u_star) {
  const std::span<const InverseMass> inverse_mass = system.inverse_mass;
  if (!has_loop(system.blocks, inverse_mass)) return 0;
  u_.resize(u_star.size());
  for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = system.u[i] - u_star[i];
  rows_.clear();
  for (const Block& block : system.blocks) {
    if (!block.binds()) {
      rows_.append() = block;
      continue;
    }
    double taken[kMaxRows];
    for (int row = 0; row < block.rows; ++row) taken[row] = -block.impulse[row];
    apply_impulse(block, taken, inverse_mass, u_);
  }
  std::int64_t flops = 0;
  for (Block& block : rows_.all()) {
    double w[kMaxRows];
    row_speeds(block, u_, w);
    for (int row = 0; row < block.rows; ++row) {
      block.bias[row] = -(w[row] + block.softness[row] * block.impulse[row]);
    }
    flops += residual_flops(block);
  }
  u_.assign(u_star.size(), Vec6::Zero());
  const System from_rest{rows_.all(), inverse_mass, u_};
  ldlt_.begin(from_rest);
  ldlt_.refine(from_rest);
  std::size_t next = 0;
  for (Block& block : system.blocks) {
    if (block.binds()) continue;
    std::copy_n(rows_.all()[next++].impulse, kMaxRows, block.impulse);
  }
  return flops + ldlt_.flops();
}

}  // namespace substep
