#include "core/solver/pgs.hpp"

#include <algorithm>
#include <type_traits>

#include "core/math/flops.hpp"
#include "core/solver/body_products.hpp"
#include "core/solver/pair.hpp"

namespace substep {

namespace {

/// Rows go two at a time where there is more than one; a last one has zeros beside it.
template <int Rows>
using Lane = std::conditional_t<Rows == 1, double, Pair>;
template <int Rows>
Lane<Rows> load(const double* from) {
  if constexpr (Rows == 1) {
    return *from;
  } else {
    return load_pair(from);
  }
}

/// w += J u. The linear part of a pinned block is `sign` times the identity.
template <int Rows, bool Pinned, std::size_t Padded>
void add_speeds(const double (&J)[6][Padded], double sign, const Vec6& u, Lane<Rows>* w) {
  if constexpr (Pinned) {
    w[0] += sign * Pair{u[0], u[1]};
    w[1] = Pair{w[1][0] + sign * u[2], w[1][1]};
  }
  for (int j = Pinned ? 3 : 0; j < 6; ++j) {
    for (int p = 0; p < (Rows + 1) / 2; ++p) w[p] += load<Rows>(&J[j][2 * p]) * u[j];
  }
}

/// u += Mt^-1 J^T change.
template <int Rows, bool Pinned>
void kick(const double (&W)[kMaxRows][6], double signed_mass, const double (&change)[kMaxRows],
          Vec6& u) {
  if constexpr (Pinned) {
    for (int j = 0; j < 3; ++j) u[j] += signed_mass * change[j];
    double sum[3];  // not in u itself: a compiler cannot know that u and W are apart
    for (int j = 0; j < 3; ++j) sum[j] = u[3 + j];
    for (int row = 0; row < Rows; ++row) {
      for (int j = 0; j < 3; ++j) sum[j] += W[row][3 + j] * change[row];
    }
    for (int j = 0; j < 3; ++j) u[3 + j] = sum[j];
  } else {
    for (int p = 0; p < 3; ++p) {
      Pair sum = load_pair(u.data() + 2 * p);
      for (int row = 0; row < Rows; ++row) sum += load_pair(&W[row][2 * p]) * change[row];
      store_pair(sum, u.data() + 2 * p);
    }
  }
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
    const int padded = block.rows == 1 ? 1 : block.rows + block.rows % 2;
    for (int i = 0; i < block.rows; ++i) {
      for (int later = i; later < block.rows; ++later) visit.coupling[i][later] = 0.0;
    }
    const auto side = [&](bool is_a, int body, double(&by_component)[6][Visit::kPadded],
                          double(&W)[kMaxRows][6], double& mass) {
      if (body < 0) return;
      Vec6 of_pin[kMaxRows];
      const double* J[kMaxRows];
      for (int i = 0; i < kMaxRows; ++i) {  // unrolled: which row it is, is known
        if (i < block.rows) J[i] = gradient(block, i, is_a, of_pin[i]);
      }
      const InverseMass& inverse = system.inverse_mass[static_cast<std::size_t>(body)];
      mass = inverse.linear;
      const int first = block.pinned ? 3 : 0;
      for (int i = 0; i < block.rows; ++i) {
        weigh(inverse, J[i], W[i]);
        for (int j = 0; j <= i; ++j) {
          for (int c = first; c < 6; ++c) visit.coupling[j][i] += J[i][c] * W[j][c];
        }
        if (block.pinned && i < 3) visit.coupling[i][i] += mass;
      }
      for (int c = first; c < 6; ++c) {
        for (int i = 0; i < block.rows; ++i) by_component[c][i] = J[i][c];
        for (int i = block.rows; i < padded; ++i) by_component[c][i] = 0.0;
      }
    };
    side(true, block.a, visit.J_a, visit.W_a, visit.mass_a);
    side(false, block.b, visit.J_b, visit.W_b, visit.mass_b);
    for (int i = 0; i < block.rows; ++i) {
      if (!warm_start) block.impulse[i] = 0.0;
      visit.bias[i] = block.bias[i];
      visit.softness[i] = block.softness[i];
      visit.impulse[i] = block.impulse[i];
      visit.inverse_diagonal[i] = 1.0 / (visit.coupling[i][i] + block.softness[i]);
    }
    for (int i = block.rows; i < padded; ++i) {
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
  Lane<Rows> lanes[Visit::kPadded / 2];
  for (int p = 0; p < (Rows + 1) / 2; ++p) {
    const auto pull = load<Rows>(block.softness + 2 * p) * load<Rows>(block.impulse + 2 * p);
    lanes[p] = load<Rows>(block.bias + 2 * p) + pull;
  }
  if (block.a >= 0)
    add_speeds<Rows, Pinned>(block.J_a, 1.0, u[static_cast<std::size_t>(block.a)], lanes);
  if (block.b >= 0)
    add_speeds<Rows, Pinned>(block.J_b, -1.0, u[static_cast<std::size_t>(block.b)], lanes);
  double w[Visit::kPadded];
  if constexpr (Rows == 1) {
    w[0] = lanes[0];
  } else {  // lane by lane: as a loop over rows it would be a copy in memory
    for (int p = 0; p < (Rows + 1) / 2; ++p) {
      w[2 * p] = lanes[p][0];
      w[2 * p + 1] = lanes[p][1];
    }
  }
  double change[kMaxRows];
  for (int i = 0; i < Rows; ++i) {
    const double x = block.impulse[i];
    double next = x - w[i] * block.inverse_diagonal[i];
    if (!Pinned && block.contact) {  // joints are unbounded
      const double hi = i == 0 ? kUnbounded : block.mu * block.impulse[0];
      const double lo = i == 0 ? 0.0 : -hi;
      next = std::min(hi, std::max(lo, next));
    }
    change[i] = next - x;
    block.impulse[i] = next;
    for (int later = i + 1; later < Rows; ++later) w[later] += block.coupling[i][later] * change[i];
  }
  if (block.a >= 0) {
    kick<Rows, Pinned>(block.W_a, block.mass_a, change, u[static_cast<std::size_t>(block.a)]);
  }
  if (block.b >= 0) {
    kick<Rows, Pinned>(block.W_b, -block.mass_b, change, u[static_cast<std::size_t>(block.b)]);
  }
}

SolveReport Pgs::find_velocities(const System& system, const Settings& settings) {
  pack(system, settings.warm_start);
  static_assert(kMaxRows == 5);
  for (int iteration = 0; iteration < settings.iterations; ++iteration) {
    for (Visit& block : visits_) {
      switch (block.rows) {
        case 1:
          visit<1, false>(block, system.u);
          break;
        case 3:
          block.pinned ? visit<3, true>(block, system.u) : visit<3, false>(block, system.u);
          break;
        default:  // 5
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
