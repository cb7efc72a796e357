#include "core/solver/pgs.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>

#include "core/math/pair.hpp"
#include "core/solver/body_products.hpp"
#include "core/solver/cost_model.hpp"
#include "core/solver/small_steps.hpp"

namespace substep {

namespace {

template <int N>
using Numbers = double[static_cast<std::size_t>(N)];
template <int N, int M>
using Table = double[static_cast<std::size_t>(N)][static_cast<std::size_t>(M)];

/// Header of every record.
struct Head {
  int a;
  int b;
  double mu;
  double lo;  // of row 0
  double hi;
  std::int8_t rows;
  bool bounded;
  bool has_point_rows;
  bool cone;
};

/// Data of a block for an iteration. J is stored by component, so that speeds are computed for two
/// rows at a time, padded with zeros. The linear part of point rows is +-E: only the angular
/// components are stored.
template <int R, bool HasPointRows>
struct Visit {
  static constexpr int Rows = R;
  static constexpr bool PointRows = HasPointRows;
  static constexpr int kPadded = Rows == 1 ? 1 : Rows + Rows % 2;
  static constexpr int kFirst = PointRows ? 3 : 0;
  static constexpr int kComponents = 6 - kFirst;

  Head head;
  double mass_a;  // 1/m of the bodies [1/kg]
  double mass_b;
  Numbers<kPadded> bias;
  Numbers<kPadded> softness;
  Numbers<kPadded> impulse;
  Table<kComponents, kPadded> J_a;
  Table<kComponents, kPadded> J_b;
  Numbers<Rows> inverse_diagonal;  // 1/(J_i Mt^-1 J_i^T + softness_i)
  Table<Rows, Rows> coupling;      // J_i Mt^-1 J_j^T within the block, [j][i] with j < i
  Table<Rows, kComponents> W_a;    // Mt^-1 J^T by row
  Table<Rows, kComponents> W_b;
};

/// The longest record type.
constexpr std::size_t kLongest = sizeof(Visit<kMaxRows, false>);

/// Calls f with a null pointer to the record type for this number of rows.
template <class F>
void with_type(int rows, bool has_point_rows, F&& f) {
  const auto either = [&]<int Rows>(std::integral_constant<int, Rows> /*rows*/) {
    return has_point_rows ? f(static_cast<Visit<Rows, true>*>(nullptr))
                          : f(static_cast<Visit<Rows, false>*>(nullptr));
  };
  static_assert(kMaxRows == 6);
  switch (rows) {
    case 1:
      return f(static_cast<Visit<1, false>*>(nullptr));
    case 2:
      return f(static_cast<Visit<2, false>*>(nullptr));
    case 3:
      return either(std::integral_constant<int, 3>{});
    case 4:
      return either(std::integral_constant<int, 4>{});
    case 5:
      return either(std::integral_constant<int, 5>{});
    default:  // 6
      return either(std::integral_constant<int, 6>{});
  }
}

/// Calls f with the record at `at`, then advances `at`.
template <class F>
void take(std::byte*& at, F&& f) {
  const Head& head = *std::launder(reinterpret_cast<const Head*>(at));
  with_type(head.rows, head.has_point_rows, [&]<class Record>(Record* /*type*/) {
    f(*std::launder(reinterpret_cast<Record*>(at)));
    at += sizeof(Record);
  });
}

/// Rows are processed in pairs if there is more than one.
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

/// w += J u. The linear part of a block with point rows is `sign` times the identity.
template <class V>
void add_speeds(const Table<V::kComponents, V::kPadded>& J, double sign, const Vec6& u,
                Lane<V::Rows>* w) {
  if constexpr (V::PointRows) {
    w[0] += sign * Pair{u[0], u[1]};
    w[1] = Pair{w[1][0] + sign * u[2], w[1][1]};
  }
  for (int j = 0; j < V::kComponents; ++j) {
    for (int p = 0; p < (V::Rows + 1) / 2; ++p) {
      w[p] += load<V::Rows>(&J[j][2 * p]) * u[V::kFirst + j];
    }
  }
}

/// u += Mt^-1 J^T change.
template <class V>
void kick(const Table<V::Rows, V::kComponents>& W, double signed_mass,
          const Numbers<V::Rows>& change, Vec6& u) {
  if constexpr (V::PointRows) {
    for (int j = 0; j < 3; ++j) u[j] += signed_mass * change[j];
    double sum[3];  // a local, because u and W may alias for the compiler
    for (int j = 0; j < 3; ++j) sum[j] = u[3 + j];
    for (int row = 0; row < V::Rows; ++row) {
      for (int j = 0; j < 3; ++j) sum[j] += W[row][j] * change[row];
    }
    for (int j = 0; j < 3; ++j) u[3 + j] = sum[j];
  } else {
    for (int p = 0; p < 3; ++p) {
      Pair sum = load_pair(u.data() + 2 * p);
      for (int row = 0; row < V::Rows; ++row) sum += load_pair(&W[row][2 * p]) * change[row];
      store_pair(sum, u.data() + 2 * p);
    }
  }
}

/// J, Mt^-1 J^T and the coupling within the block through one of its bodies.
template <class V>
void pack_side(const Block& block, bool is_a, const InverseMass& inverse, V& visit) {
  auto& by_component = is_a ? visit.J_a : visit.J_b;
  auto& W = is_a ? visit.W_a : visit.W_b;
  constexpr std::size_t kRows = V::Rows;
  Vec6 of_pin[kRows];
  const double* J[kRows];
  Table<V::Rows, 6> weighed;
  for (int i = 0; i < V::Rows; ++i) {
    J[i] = gradient(block, i, is_a, of_pin[i]);
    weigh(inverse, J[i], weighed[i]);
    for (int j = 0; j <= i; ++j) {
      for (int c = V::kFirst; c < 6; ++c) visit.coupling[j][i] += J[i][c] * weighed[j][c];
    }
    if (V::PointRows && i < 3) visit.coupling[i][i] += inverse.linear;
  }
  for (int c = 0; c < V::kComponents; ++c) {
    for (int i = 0; i < V::Rows; ++i) {
      by_component[c][i] = J[i][V::kFirst + c];
      W[i][c] = weighed[i][V::kFirst + c];
    }
    for (int i = V::Rows; i < V::kPadded; ++i) by_component[c][i] = 0.0;
  }
  (is_a ? visit.mass_a : visit.mass_b) = inverse.linear;
}

/// Both tangents use one common step size, short enough for both together, so that the residual
/// converges along the sliding direction.
template <class V>
void pack_cone(V& visit) {
  const double most = std::max(visit.coupling[1][1], visit.coupling[2][2]) +
                      std::abs(visit.coupling[1][2]) + visit.softness[1];
  visit.inverse_diagonal[1] = visit.inverse_diagonal[2] = 1.0 / most;
  visit.coupling[1][2] = 0.0;
}

template <class V>
void pack_block(const Block& block, std::span<const InverseMass> inverse_mass, bool cone,
                V& visit) {
  visit.head = {block.a,
                block.b,
                block.mu,
                block.lo,
                block.hi,
                static_cast<std::int8_t>(block.rows),
                block.is_bounded(),
                block.has_point_rows,
                cone && block.is_contact() && block.rows == 3};
  for (int i = 0; i < V::Rows; ++i) {
    for (int later = i; later < V::Rows; ++later) visit.coupling[i][later] = 0.0;
  }
  for (const bool is_a : {true, false}) {
    const int body = is_a ? block.a : block.b;
    if (body >= 0) pack_side(block, is_a, inverse_mass[index(body)], visit);
  }
  for (int i = 0; i < V::Rows; ++i) {
    visit.bias[i] = block.bias[i];
    visit.softness[i] = block.softness[i];
    visit.impulse[i] = block.impulse[i];
    visit.inverse_diagonal[i] = 1.0 / (visit.coupling[i][i] + block.softness[i]);
  }
  if constexpr (V::Rows == 3 && !V::PointRows) {
    if (visit.head.cone) pack_cone(visit);
  }
  for (int i = V::Rows; i < V::kPadded; ++i) {
    visit.bias[i] = visit.softness[i] = visit.impulse[i] = 0.0;
  }
}

/// Clamps the length of the friction impulse to mu times the normal impulse.
template <class V>
void keep_in_cone(V& block, Numbers<V::Rows>& change) {
  const double bound = block.head.mu * block.impulse[0];
  const double square = block.impulse[1] * block.impulse[1] + block.impulse[2] * block.impulse[2];
  if (square <= bound * bound) return;
  const double scale = bound / std::sqrt(square);
  for (int i = 1; i < 3; ++i) {
    const double kept = scale * block.impulse[i];
    change[i] += kept - block.impulse[i];
    block.impulse[i] = kept;
  }
}

// Row by row, but u is read and written once per block: changes by earlier rows of the block enter
// through `coupling`. Equal to updating u after every row, up to rounding, with shorter dependency
// chains.
template <class V>
void update(V& block, std::span<Vec6> u) {
  constexpr int Rows = V::Rows;
  const int a = block.head.a, b = block.head.b;
  Lane<Rows> lanes[std::size_t{(Rows + 1) / 2}];
  for (int p = 0; p < (Rows + 1) / 2; ++p) {
    const auto pull = load<Rows>(block.softness + 2 * p) * load<Rows>(block.impulse + 2 * p);
    lanes[p] = load<Rows>(block.bias + 2 * p) + pull;
  }
  if (a >= 0) add_speeds<V>(block.J_a, 1.0, u[static_cast<std::size_t>(a)], lanes);
  if (b >= 0) add_speeds<V>(block.J_b, -1.0, u[static_cast<std::size_t>(b)], lanes);
  Numbers<V::kPadded> w;
  if constexpr (Rows == 1) {
    w[0] = lanes[0];
  } else {  // per lane, to avoid a memory copy
    for (int p = 0; p < (Rows + 1) / 2; ++p) {
      w[2 * p] = lanes[p][0];
      w[2 * p + 1] = lanes[p][1];
    }
  }
  Numbers<Rows> change;
  for (int i = 0; i < Rows; ++i) {
    const double x = block.impulse[i];
    double next = x - w[i] * block.inverse_diagonal[i];
    if (!V::PointRows && block.head.bounded) {  // joints are unbounded
      const double across = block.head.cone ? kUnbounded : block.head.mu * block.impulse[0];
      const double hi = i == 0 ? block.head.hi : across;
      const double lo = i == 0 ? block.head.lo : -across;
      next = std::min(hi, std::max(lo, next));
    }
    change[i] = next - x;
    block.impulse[i] = next;
    for (int later = i + 1; later < Rows; ++later) w[later] += block.coupling[i][later] * change[i];
  }
  if constexpr (Rows == 3 && !V::PointRows) {
    if (block.head.cone) keep_in_cone(block, change);
  }
  if (a >= 0) kick<V>(block.W_a, block.mass_a, change, u[static_cast<std::size_t>(a)]);
  if (b >= 0) kick<V>(block.W_b, -block.mass_b, change, u[static_cast<std::size_t>(b)]);
}

}  // namespace

void Pgs::reserve(std::size_t /*bodies*/, std::size_t blocks, bool /*loops*/) {
  if (blocks * kLongest <= capacity_) return;
  capacity_ = blocks * kLongest;
  records_.reset(new std::byte[capacity_]);  // unlike make_unique, uninitialised
}

void Pgs::pack(const System& system, bool warm_start, bool cone) {
  reserve(system.u.size(), system.blocks.size(), false);
  std::byte* at = records_.get();
  for (Block& block : system.blocks) {
    if (!warm_start) std::fill(block.impulse, block.impulse + block.rows, 0.0);
    with_type(block.rows, block.has_point_rows, [&]<class Record>(Record* /*type*/) {
      pack_block(block, system.inverse_mass, cone, *::new (at) Record);
      at += sizeof(Record);
    });
    if (warm_start) apply_impulse(block, block.impulse, system.inverse_mass, system.u);
  }
}

SolveReport Pgs::find_velocities(const System& system, const Settings& settings) {
  const bool cone = settings.friction_cone == FrictionCone::kCone;
  SolveReport report;
  const int iterations = iterations_of(settings, system.frame_share);
  report.iterations = iterations;
  for (const Block& block : system.blocks) {
    report.row_updates += static_cast<std::int64_t>(block.rows) * iterations;
    report.flops += pack_flops(block) + visit_flops(block) * iterations;
  }
  if (static_cast<double>(report.flops) > system.limits.work) {
    return {.status = SolveStatus::kOverLimits, .work_needed = static_cast<double>(report.flops)};
  }
  pack(system, settings.warm_start, cone);
  const std::size_t count = system.blocks.size();
  for (int iteration = 0; iteration < iterations; ++iteration) {
    std::byte* at = records_.get();
    for (std::size_t k = 0; k < count; ++k) {
      take(at, [&](auto& visit) { update(visit, system.u); });
    }
  }
  std::byte* at = records_.get();
  for (Block& block : system.blocks) {
    take(at,
         [&](auto& visit) { std::copy(visit.impulse, visit.impulse + block.rows, block.impulse); });
    if (cone && block.is_contact() && block.rows == 3) {
      point_cone(block, block.impulse[1], block.impulse[2]);
    }
  }
  return report;
}

std::unique_ptr<Solver> make_pgs() { return std::make_unique<Pgs>(); }

}  // namespace substep
