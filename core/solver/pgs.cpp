#include "core/solver/pgs.hpp"

#include <algorithm>

namespace substep {

namespace {

double dot(const double (&J)[6], const Vec6& u) {
  return (J[0] * u[0] + J[1] * u[1] + J[2] * u[2]) + (J[3] * u[3] + J[4] * u[4] + J[5] * u[5]);
}

/// W = Mt^-1 J^T of one row on one body.
Vec6 response(const double (&J)[6], const InverseMass& mass) {
  Vec6 W;
  for (int i = 0; i < 3; ++i) {
    W[i] = mass.linear * J[i];
    W[3 + i] = mass.angular(i, 0) * J[3] + mass.angular(i, 1) * J[4] + mass.angular(i, 2) * J[5];
  }
  return W;
}

/// w += J u. `sign` times the identity stands in the linear part of a pinned block.
template <int Rows, bool Pinned>
void add_speeds(const double (&J)[kMaxRows][6], double sign, const Vec6& u, double (&w)[kMaxRows]) {
  if constexpr (Pinned) {
    for (int i = 0; i < 3; ++i) w[i] += sign * u[i];
    for (int i = 0; i < Rows; ++i) w[i] += J[i][3] * u[3] + J[i][4] * u[4] + J[i][5] * u[5];
  } else {
    for (int i = 0; i < Rows; ++i) w[i] += dot(J[i], u);
  }
}

/// u += Mt^-1 J^T change.
template <int Rows, bool Pinned>
void kick(const double (&J)[kMaxRows][6], double sign, const double (&change)[kMaxRows],
          const InverseMass& mass, Vec6& u) {
  constexpr int kFirst = Pinned ? 3 : 0;
  double f[6];
  if constexpr (Pinned) {
    for (int j = 0; j < 3; ++j) f[j] = sign * change[j];
  }
  for (int j = kFirst; j < 6; ++j) f[j] = J[0][j] * change[0];
  for (int row = 1; row < Rows; ++row) {
    for (int j = kFirst; j < 6; ++j) f[j] += J[row][j] * change[row];
  }
  for (int i = 0; i < 3; ++i) {
    u[i] += mass.linear * f[i];
    u[3 + i] += mass.angular(i, 0) * f[3] + mass.angular(i, 1) * f[4] + mass.angular(i, 2) * f[5];
  }
}

}  // namespace

void Pgs::reserve(std::size_t /*bodies*/, std::size_t blocks) { visits_.reserve(blocks); }

// Row by row, but u is written once per block: what the rows before it in the block have changed
// reaches a row through `coupling`. The same numbers as one row after the other, up to rounding, and
// without waiting for u after every row.
template <int Rows, bool Pinned>
void Pgs::visit(Visit& block, const System& system) {
  double w[kMaxRows];
  for (int i = 0; i < Rows; ++i) w[i] = block.bias[i] + block.softness[i] * block.impulse[i];
  if (block.a >= 0) {
    add_speeds<Rows, Pinned>(block.J_a, 1.0, system.u[static_cast<std::size_t>(block.a)], w);
  }
  if (block.b >= 0) {
    add_speeds<Rows, Pinned>(block.J_b, -1.0, system.u[static_cast<std::size_t>(block.b)], w);
  }
  double change[kMaxRows];
  for (int i = 0; i < Rows; ++i) {
    for (int j = 0; j < i; ++j) w[i] += block.coupling[i][j] * change[j];
    const double x = block.impulse[i];
    double next = x - w[i] * block.inverse_diagonal[i];
    if (!Pinned && block.contact) {  // joints are unbounded
      const double hi = i == 0 ? kUnbounded : block.mu * block.impulse[0];
      const double lo = i == 0 ? 0.0 : -hi;
      next = std::min(hi, std::max(lo, next));
    }
    change[i] = next - x;
    block.impulse[i] = next;
  }
  if (block.a >= 0) {
    const auto a = static_cast<std::size_t>(block.a);
    kick<Rows, Pinned>(block.J_a, 1.0, change, system.inverse_mass[a], system.u[a]);
  }
  if (block.b >= 0) {
    const auto b = static_cast<std::size_t>(block.b);
    kick<Rows, Pinned>(block.J_b, -1.0, change, system.inverse_mass[b], system.u[b]);
  }
}

SolveReport Pgs::solve(const System& system, const Settings& settings) {
  SolveReport report;
  visits_.resize(system.blocks.size());
  for (std::size_t k = 0; k < visits_.size(); ++k) {
    Block& block = system.blocks[k];
    Visit& visit = visits_[k];
    visit.a = block.a;
    visit.b = block.b;
    visit.rows = block.rows;
    visit.contact = block.is_contact();
    visit.pinned = block.pinned;
    visit.mu = block.mu;
    report.row_updates += block.rows;
    const auto pack = [&](const double (&from)[kMaxRows][6], int body, double (&to)[kMaxRows][6], int i) {
      if (body < 0) return;
      std::copy(from[i], from[i] + 6, to[i]);
      const Vec6 W = response(from[i], system.inverse_mass[static_cast<std::size_t>(body)]);
      for (int j = 0; j <= i; ++j) visit.coupling[i][j] += dot(to[j], W);
    };
    for (int i = 0; i < block.rows; ++i) {
      for (int j = 0; j <= i; ++j) visit.coupling[i][j] = 0.0;
      pack(block.J_a, block.a, visit.J_a, i);
      pack(block.J_b, block.b, visit.J_b, i);
      visit.inverse_diagonal[i] = 1.0 / (visit.coupling[i][i] + block.softness[i]);
      visit.bias[i] = block.bias[i];
      visit.softness[i] = block.softness[i];
      if (!settings.warm_start) block.impulse[i] = 0.0;
      visit.impulse[i] = block.impulse[i];
    }
    if (settings.warm_start) apply_impulse(block, block.impulse, system.inverse_mass, system.u);
  }
  static_assert(kMaxRows == 5);
  for (int iteration = 0; iteration < settings.iterations; ++iteration) {
    for (Visit& block : visits_) {
      switch (block.rows) {
        case 1: visit<1, false>(block, system); break;
        case 2: visit<2, false>(block, system); break;
        case 3: block.pinned ? visit<3, true>(block, system) : visit<3, false>(block, system); break;
        case 4: visit<4, false>(block, system); break;
        default: block.pinned ? visit<5, true>(block, system) : visit<5, false>(block, system); break;
      }
    }
  }
  for (std::size_t k = 0; k < visits_.size(); ++k) {
    std::copy(visits_[k].impulse, visits_[k].impulse + visits_[k].rows, system.blocks[k].impulse);
  }
  report.iterations = settings.iterations;
  report.row_updates *= settings.iterations;
  return report;
}

}  // namespace substep
