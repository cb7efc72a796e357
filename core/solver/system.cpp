#include "core/solver/system.hpp"

#include <algorithm>
#include <cmath>

namespace substep {

namespace {

void apply_to(const double (&J)[kMaxRows][6], int rows, const double* impulse, const InverseMass& mass,
              Vec6& u) {
  double f[6] = {};
  for (int row = 0; row < rows; ++row) {
    for (int j = 0; j < 6; ++j) f[j] += J[row][j] * impulse[row];
  }
  for (int i = 0; i < 3; ++i) {
    u[i] += mass.linear * f[i];
    u[3 + i] += mass.angular(i, 0) * f[3] + mass.angular(i, 1) * f[4] + mass.angular(i, 2) * f[5];
  }
}

}  // namespace

void apply_impulse(const Block& block, const double* impulse, std::span<const InverseMass> inverse_mass,
                   std::span<Vec6> u) {
  if (block.a >= 0) {
    const auto a = static_cast<std::size_t>(block.a);
    apply_to(block.J_a, block.rows, impulse, inverse_mass[a], u[a]);
  }
  if (block.b >= 0) {
    const auto b = static_cast<std::size_t>(block.b);
    apply_to(block.J_b, block.rows, impulse, inverse_mass[b], u[b]);
  }
}

double lcp_residual(const System& system) {
  double worst = 0.0;
  for (const Block& block : system.blocks) {
    for (int row = 0; row < block.rows; ++row) {
      double lo = -kUnbounded;
      double hi = kUnbounded;
      if (block.is_contact()) {
        hi = row == 0 ? kUnbounded : block.mu * std::max(0.0, block.impulse[0]);
        lo = row == 0 ? 0.0 : -hi;
      }
      const double x = block.impulse[row];
      const double w =
          row_speed(block, row, system.u) + block.softness[row] * x + block.bias[row];
      // The natural residual: zero just where w and x are complementary.
      const double projected = std::min(hi, std::max(lo, x - w));
      worst = std::max(worst, std::abs(x - projected));
    }
  }
  return worst;
}

}  // namespace substep
