#include "core/stepping/drift.hpp"

namespace substep {

void set_drift_bias(std::span<Block> blocks, Drift law, double tau, double dt) {
  const double full = 1.0 / dt;
  const double rate = law == Drift::kSoft && dt < tau ? dt / (tau * tau) : full;
  for (Block& block : blocks) {
    for (int row = 0; row < block.rows; ++row) block.bias[row] = block.phi[row] * rate;
    if (block.is_contact() && block.phi[0] > 0.0) block.bias[0] = block.phi[0] * full;
  }
}

void set_probe_bias(std::span<Block> blocks, double dt) {
  for (Block& block : blocks) {
    for (int row = 0; row < block.rows; ++row) block.bias[row] = 0.0;
    if (block.is_contact() && block.phi[0] > 0.0) block.bias[0] = block.phi[0] / dt;
  }
}

}  // namespace substep
