#include "core/solver/pgs.hpp"

#include <algorithm>

#include "core/math/flops.hpp"

namespace substep {

namespace {

/// W = Mt^-1 J^T of one row on one body.
void response(const double (&J)[6], const InverseMass& mass, double (&W)[6]) {
  for (int i = 0; i < 3; ++i) {
    W[i] = mass.linear * J[i];
    W[3 + i] = mass.angular(i, 0) * J[3] + mass.angular(i, 1) * J[4] + mass.angular(i, 2) * J[5];
  }
}

/// w += J u, all rows side by side. The linear part of a pinned block is `sign` times the identity.
template <int Rows, bool Pinned, std::size_t Padded>
void add_speeds(const double (&J)[6][Padded], double sign, const Vec6& u, double (&w)[Padded]) {
  constexpr int kWidth = Rows == 1 ? 1 : Rows + Rows % 2;
  if constexpr (Pinned) {
    for (int i = 0; i < 3; ++i) w[i] += sign * u[i];
  }
  for (int j = Pinned ? 3 : 0; j < 6; ++j) {
    for (int i = 0; i < kWidth; ++i) w[i] += J[j][i] * u[j];
  }
}

/// u += Mt^-1 J^T change.
template <int Rows, bool Pinned>
void kick(const double (&W)[kMaxRows][6], double signed_mass, const double (&change)[kMaxRows],
          Vec6& u) {
  constexpr int kFirst = Pinned ? 3 : 0;
  if constexpr (Pinned) {
    for (int j = 0; j < 3; ++j) u[j] += signed_mass * change[j];
  }
  double sum[6];  // not in u itself: a compiler cannot know that u and W are apart
  for (int j = kFirst; j < 6; ++j) sum[j] = u[j];
  for (int row = 0; row < Rows; ++row) {
    for (int j = kFirst; j < 6; ++j) sum[j] += W[row][j] * change[row];
  }
  for (int j = kFirst; j < 6; ++j) u[j] = sum[j];
}

/// Of one visit to a block: J u and Mt^-1 J^T change on each body, the coupling of its rows, and
/// per row the softness, the step and the bounds.
std::int64_t visit_flops(const Block& block) {
  const std::int64_t n = block.rows;
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  const std::int64_t multiplied = block.pinned ? 3 : 6;  // the rest of a pinned J is +-E
  return bodies * (2 * product_flops(n, multiplied, 1) + (block.pinned ? 9 : 0)) +
         unit_triangle_flops(n) + 5 * n;
}

/// Of packing a block: Mt^-1 J^T and the products of its rows on each body.
std::int64_t pack_flops(const Block& block) {
  const std::int64_t n = block.rows;
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  const std::int64_t multiplied = block.pinned ? 3 : 6;
  return bodies * (18 * n + n * (n + 1) * multiplied + (block.pinned ? 3 : 0)) + 2 * n;
}

}  // namespace

void Pgs::reserve(std::size_t /*bodies*/, std::size_t blocks) { visits_.reserve(blocks); }

void Pgs::pack(const System& system, bool warm_start) {
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
    for (int i = 0; i < block.rows; ++i) {
      std::fill(visit.coupling[i], visit.coupling[i] + kMaxRows, 0.0);
    }
    const auto side = [&](const double(&J)[kMaxRows][6], int body,
                          double(&by_component)[6][Visit::kPadded], double(&W)[kMaxRows][6],
                          double& mass) {
      if (body < 0) return;
      const InverseMass& inverse = system.inverse_mass[static_cast<std::size_t>(body)];
      mass = inverse.linear;
      const int first = block.pinned ? 3 : 0;
      for (int i = 0; i < block.rows; ++i) {
        response(J[i], inverse, W[i]);
        for (int j = 0; j <= i; ++j) {
          for (int c = first; c < 6; ++c) visit.coupling[i][j] += J[i][c] * W[j][c];
        }
        if (block.pinned && i < 3) visit.coupling[i][i] += mass;
      }
      for (int c = first; c < 6; ++c) {
        for (int i = 0; i < block.rows; ++i) by_component[c][i] = J[i][c];
        for (std::size_t i = static_cast<std::size_t>(block.rows); i < Visit::kPadded; ++i) {
          by_component[c][i] = 0.0;
        }
      }
    };
    side(block.J_a, block.a, visit.J_a, visit.W_a, visit.mass_a);
    side(block.J_b, block.b, visit.J_b, visit.W_b, visit.mass_b);
    for (int i = 0; i < block.rows; ++i) {
      if (!warm_start) block.impulse[i] = 0.0;
      visit.bias[i] = block.bias[i];
      visit.softness[i] = block.softness[i];
      visit.impulse[i] = block.impulse[i];
      visit.inverse_diagonal[i] = 1.0 / (visit.coupling[i][i] + block.softness[i]);
    }
    for (std::size_t i = static_cast<std::size_t>(block.rows); i < Visit::kPadded; ++i) {
      visit.bias[i] = visit.softness[i] = visit.impulse[i] = 0.0;
    }
    if (warm_start) apply_impulse(block, block.impulse, system.inverse_mass, system.u);
  }
}

// Row by row, but u is read and written once per block: what the rows before it in the block have
// changed reaches a row through `coupling`. The same numbers as one row after the other, up to
// rounding, and without waiting for u after every row.
template <int Rows, bool Pinned>
void Pgs::visit(Visit& block, std::span<Vec6> u) {
  double w[Visit::kPadded];
  for (std::size_t i = 0; i < Visit::kPadded; ++i)
    w[i] = block.bias[i] + block.softness[i] * block.impulse[i];
  if (block.a >= 0)
    add_speeds<Rows, Pinned>(block.J_a, 1.0, u[static_cast<std::size_t>(block.a)], w);
  if (block.b >= 0)
    add_speeds<Rows, Pinned>(block.J_b, -1.0, u[static_cast<std::size_t>(block.b)], w);
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
    kick<Rows, Pinned>(block.W_a, block.mass_a, change, u[static_cast<std::size_t>(block.a)]);
  }
  if (block.b >= 0) {
    kick<Rows, Pinned>(block.W_b, -block.mass_b, change, u[static_cast<std::size_t>(block.b)]);
  }
}

SolveReport Pgs::solve(const System& system, const Settings& settings) {
  pack(system, settings.warm_start);
  static_assert(kMaxRows == 5);
  for (int iteration = 0; iteration < settings.iterations; ++iteration) {
    for (Visit& block : visits_) {
      switch (block.rows) {
        case 1:
          visit<1, false>(block, system.u);
          break;
        case 2:
          visit<2, false>(block, system.u);
          break;
        case 3:
          block.pinned ? visit<3, true>(block, system.u) : visit<3, false>(block, system.u);
          break;
        case 4:
          visit<4, false>(block, system.u);
          break;
        default:
          block.pinned ? visit<5, true>(block, system.u) : visit<5, false>(block, system.u);
          break;
      }
    }
  }
  SolveReport report;
  report.iterations = settings.iterations;
  for (std::size_t k = 0; k < visits_.size(); ++k) {
    std::copy(visits_[k].impulse, visits_[k].impulse + visits_[k].rows, system.blocks[k].impulse);
    report.row_updates += static_cast<std::int64_t>(visits_[k].rows) * settings.iterations;
    report.flops +=
        pack_flops(system.blocks[k]) + visit_flops(system.blocks[k]) * settings.iterations;
  }
  return report;
}

}  // namespace substep
