#include "core/solver/system.hpp"

#include <algorithm>
#include <cmath>

namespace substep {

namespace {

/// f = J^T impulse, with `sign` times the identity in the linear parts of a pinned block.
void gather(const Block& block, const double (&J)[kMaxRows][6], double sign, const double* impulse,
            double (&f)[6]) {
  for (double& component : f) component = 0.0;
  if (block.pinned) {
    for (int j = 0; j < 3; ++j) f[j] = sign * impulse[j];
    for (int row = 0; row < block.rows; ++row) {
      for (int j = 3; j < 6; ++j) f[j] += J[row][j] * impulse[row];
    }
  } else {
    for (int row = 0; row < block.rows; ++row) {
      for (int j = 0; j < 6; ++j) f[j] += J[row][j] * impulse[row];
    }
  }
}

void kick(const double (&f)[6], const InverseMass& mass, Vec6& u) {
  for (int i = 0; i < 3; ++i) {
    u[i] += mass.linear * f[i];
    u[3 + i] += mass.angular(i, 0) * f[3] + mass.angular(i, 1) * f[4] + mass.angular(i, 2) * f[5];
  }
}

void add_speeds(const Block& block, const double (&J)[kMaxRows][6], double sign, const Vec6& u,
                double* speed) {
  if (block.pinned) {
    for (int row = 0; row < block.rows; ++row) {
      speed[row] += J[row][3] * u[3] + J[row][4] * u[4] + J[row][5] * u[5];
    }
    for (int j = 0; j < 3; ++j) speed[j] += sign * u[j];
  } else {
    for (int row = 0; row < block.rows; ++row) {
      speed[row] += (J[row][0] * u[0] + J[row][1] * u[1] + J[row][2] * u[2]) +
                    (J[row][3] * u[3] + J[row][4] * u[4] + J[row][5] * u[5]);
    }
  }
}

}  // namespace

void row_speeds(const Block& block, std::span<const Vec6> u, double* speed) {
  for (int row = 0; row < block.rows; ++row) speed[row] = 0.0;
  if (block.a >= 0) add_speeds(block, block.J_a, 1.0, u[static_cast<std::size_t>(block.a)], speed);
  if (block.b >= 0) add_speeds(block, block.J_b, -1.0, u[static_cast<std::size_t>(block.b)], speed);
}

void apply_impulse(const Block& block, const double* impulse,
                   std::span<const InverseMass> inverse_mass, std::span<Vec6> u) {
  double f[6];
  if (block.a >= 0) {
    const auto a = static_cast<std::size_t>(block.a);
    gather(block, block.J_a, 1.0, impulse, f);
    kick(f, inverse_mass[a], u[a]);
  }
  if (block.b >= 0) {
    const auto b = static_cast<std::size_t>(block.b);
    gather(block, block.J_b, -1.0, impulse, f);
    kick(f, inverse_mass[b], u[b]);
  }
}

double lcp_residual(const System& system) {
  double worst = 0.0;
  double speed[kMaxRows];
  for (const Block& block : system.blocks) {
    row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      double lo = -kUnbounded;
      double hi = kUnbounded;
      if (block.is_contact()) {
        hi = row == 0 ? kUnbounded : block.mu * std::max(0.0, block.impulse[0]);
        lo = row == 0 ? 0.0 : -hi;
      }
      const double x = block.impulse[row];
      const double w = speed[row] + block.softness[row] * x + block.bias[row];
      // The natural residual: zero just where w and x are complementary.
      const double projected = std::min(hi, std::max(lo, x - w));
      worst = std::max(worst, std::abs(x - projected));
    }
  }
  return worst;
}

}  // namespace substep
