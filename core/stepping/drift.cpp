#include "core/stepping/drift.hpp"

#include "core/constraints/hinge_joint.hpp"

namespace substep {

void set_drift_bias(std::span<Block> blocks, Drift law, double tau, double dt) {
  const double full = 1.0 / dt;
  const double rate = law == Drift::kSoft && dt < tau ? dt / (tau * tau) : full;
  for (Block& block : blocks) {  // all that there is room for: a number that the compiler knows
    for (int row = 0; row < kMaxRows; ++row) block.bias[row] = block.phi[row] * rate;
    if (block.is_contact() && block.phi[0] > 0.0) block.bias[0] = block.phi[0] * full;
  }
}

void add_curvature_bias(std::span<Block> blocks, std::span<const Vec6> u, double dt) {
  const auto turning = [&](int body) -> Vec3 {
    return body < 0 ? Vec3::Zero() : Vec3(u[static_cast<std::size_t>(body)].tail<3>());
  };
  double curvature[kMaxRows];
  for (Block& block : blocks) {
    if (block.is_contact()) continue;
    if (block.kind == BlockKind::kHinge) {
      hinge_curvature(block, turning(block.a), turning(block.b), curvature);
    } else {
      ball_curvature(block, turning(block.a), turning(block.b), curvature);
    }
    for (int row = 0; row < block.rows; ++row) block.bias[row] += 0.5 * dt * curvature[row];
  }
}

void set_probe_bias(std::span<Block> blocks, double dt) {
  for (Block& block : blocks) {
    for (int row = 0; row < block.rows; ++row) block.bias[row] = 0.0;
    if (block.is_contact() && block.phi[0] > 0.0) block.bias[0] = block.phi[0] / dt;
  }
}

}  // namespace substep
