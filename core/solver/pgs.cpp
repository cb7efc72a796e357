#include "core/solver/pgs.hpp"

#include <algorithm>

namespace substep {

namespace {

/// W = Mt^-1 J^T of one row on one body. @return its part of the diagonal, J W
double response(const double (&J)[6], const InverseMass& mass, double (&W)[6]) {
  for (int i = 0; i < 3; ++i) {
    W[i] = mass.linear * J[i];
    W[3 + i] = mass.angular(i, 0) * J[3] + mass.angular(i, 1) * J[4] + mass.angular(i, 2) * J[5];
  }
  double d = 0.0;
  for (int j = 0; j < 6; ++j) d += J[j] * W[j];
  return d;
}

double dot(const double (&J)[6], const Vec6& u) {
  return (J[0] * u[0] + J[1] * u[1] + J[2] * u[2]) + (J[3] * u[3] + J[4] * u[4] + J[5] * u[5]);
}

void add(const double (&W)[6], double x, Vec6& u) {
  for (int j = 0; j < 6; ++j) u[j] += W[j] * x;
}

}  // namespace

void Pgs::reserve(std::size_t /*bodies*/, std::size_t blocks) { rows_.reserve(blocks * kMaxRows); }

SolveReport Pgs::solve(const System& system, const Settings& settings) {
  const auto body = [&](int i) -> Vec6& { return system.u[static_cast<std::size_t>(i)]; };

  rows_.clear();
  for (Block& block : system.blocks) {
    for (int i = 0; i < block.rows; ++i) {
      Row& row = rows_.emplace_back();
      double diagonal = block.softness[i];
      if (block.a >= 0) {
        diagonal += response(block.J_a[i], system.inverse_mass[static_cast<std::size_t>(block.a)], row.W_a);
      }
      if (block.b >= 0) {
        diagonal += response(block.J_b[i], system.inverse_mass[static_cast<std::size_t>(block.b)], row.W_b);
      }
      row.inverse_diagonal = 1.0 / diagonal;
      if (!settings.warm_start) block.impulse[i] = 0.0;
      if (block.impulse[i] != 0.0) {
        if (block.a >= 0) add(row.W_a, block.impulse[i], body(block.a));
        if (block.b >= 0) add(row.W_b, block.impulse[i], body(block.b));
      }
    }
  }

  SolveReport report;
  for (int iteration = 0; iteration < settings.iterations; ++iteration) {
    const Row* row = rows_.data();
    for (Block& block : system.blocks) {
      for (int i = 0; i < block.rows; ++i, ++row) {
        const double x = block.impulse[i];
        double w = block.softness[i] * x + block.bias[i];
        if (block.a >= 0) w += dot(block.J_a[i], body(block.a));
        if (block.b >= 0) w += dot(block.J_b[i], body(block.b));
        double next = x - w * row->inverse_diagonal;
        if (block.is_contact()) {
          const double hi = i == 0 ? kUnbounded : block.mu * block.impulse[0];
          const double lo = i == 0 ? 0.0 : -hi;
          next = std::min(hi, std::max(lo, next));
        }
        const double change = next - x;
        block.impulse[i] = next;
        if (block.a >= 0) add(row->W_a, change, body(block.a));
        if (block.b >= 0) add(row->W_b, change, body(block.b));
      }
    }
  }
  report.iterations = settings.iterations;
  report.row_updates = static_cast<std::int64_t>(rows_.size()) * settings.iterations;
  return report;
}

}  // namespace substep
