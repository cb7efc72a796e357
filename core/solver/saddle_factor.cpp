// Factorisation of a node.

#include <algorithm>
#include <utility>

#include "core/solver/body_products.hpp"
#include "core/solver/dense_ldlt.hpp"
#include "core/solver/saddle_ldlt.hpp"

namespace substep {

namespace {

// Exact rows that are redundant on their node's body, as in closed loops of exact joints, may be
// independent in the whole system. Below this fraction of J A^-1 J^T a pivot is taken for zero.
constexpr double kLeastPivot = 1e-8;

// Clears an even number of values in pairs; memset would be a call in WebAssembly.
void set_zero(double* to, int n) {
  for (int i = 0; i < n; i += 2) store_pair(Pair{0.0, 0.0}, to + i);
}

}  // namespace

void SaddleLdlt::count(Node& node) const {
  node.counted_rows = node.n_rows;
  if (node.kind == NodeKind::kArticulated) {
    const Attached& attached = attached_[node.first_attached];
    node.flops = articulated_flops(keys_[index(attached.block)].rows(), attached.exact);
  } else {
    node.flops =
        node_flops(node.n_rows, width(node), node.kind != NodeKind::kGeneral, node.springs);
  }
  node.flops.factor += node.update_flops;
}

void SaddleLdlt::add_inertia(const Node& node, Square6& A) const {
  const InverseMass& inverse = inverse_mass_[index(node.body)];
  double I[3][3];
  inverse_of(inverse.angular, I);
  const double mass = 1.0 / inverse.linear;
  for (int i = 0; i < 3; ++i) {
    A[i][i] += mass;
    A[3 + i][3 + i] += I[i][i];
    for (int j = 0; j < i; ++j) A[3 + i][3 + j] += I[i][j];
  }
}

// Adds a node's contribution to its coupled bodies, the first of which is its parent. A leaf node
// stores only its rows: the contribution has low rank and is cheaper to form at the destination.
void SaddleLdlt::add_left(const Node& child, Square6& A, double* B, double* U, int n) {
  if (child.kind == NodeKind::kArticulated) {  // upper half only
    Square6 left;
    child.joint->left(left);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) A[i][j] += left[j][i];
    }
    return;
  }
  const auto each_block = [&](int coupled, const auto& add) {
    constexpr std::true_type on_diagonal;
    constexpr std::false_type beside_it;
    const int* place = place_.data() + child.first_coupled;
    add(on_diagonal, 0, 0, A[0], 6);
    for (int t = 1; t < coupled; ++t) {
      add(beside_it, 0, t, B + 6 * place[t], n);
      for (int s = 1; s < t; ++s) add(beside_it, s, t, U + 6 * (place[s] * n + place[t]), n);
      add(on_diagonal, t, t, U + 6 * (place[t] * n + place[t]), n);
    }
  };
  if (child.kind == NodeKind::kLeaf) {
    const Factor f = at(child);
    const int* first = first_filled_.data() + child.first_coupled;
    with_known_width(child, [&](auto m) {
      each_block(m / 6, [&](auto on_diagonal, int s, int t, double* to, int stride) {
        const int row = std::max(first[s], first[t]);
        with_known(child.n_rows - row, [&](auto rows) {
          const double* Z = f.Z + row * m;
          add_gram_block<on_diagonal>(Z + 6 * s, Z + 6 * t, f.S_inverse + row, rows, 1.0, m, to,
                                      stride);
        });
      });
    });
    return;
  }
  const int m = width(child);
  const double* left = values_.data() + child.update;
  each_block(child.coupled, [&](auto on_diagonal, int s, int t, double* to, int stride) {
    const double* from = left + 6 * (s * m + t);
    for (int i = 0; i < 6; ++i) {
      const int end = on_diagonal ? i + 1 : 6;
      for (int j = 0; j < end; ++j) to[i * stride + j] += from[i * m + j];
    }
  });
}

// Sum of the children's contributions to an articulated node, about its pivot.
void SaddleLdlt::sum_carried(const Node& node, Square6& sum) {
  std::fill(&sum[0][0], &sum[0][0] + 36, 0.0);
  for (std::size_t c = 0; c < node.n_children; ++c) {
    const Node& child = nodes_[index(children_[node.first_child + c])];
    Square6 left;
    if (child.kind == NodeKind::kArticulated) {
      child.joint->left(left);
    } else {
      Square6 lower = {};
      add_left(child, lower, nullptr, nullptr, 0);
      shift([&](int i, int j) { return lower[j][i]; }, node.joint->pivot(), left);
    }
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) sum[i][j] += left[i][j];
    }
  }
}

void SaddleLdlt::gather_rows(Node& node, std::span<const Block> blocks) {
  if (node.gathered) return;
  node.gathered = !node.has_bounds;
  node.n_rows = 0;
  node.springs = {};
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const Attached& attached = attached_[node.first_attached + k];
    const Block& block = blocks[index(attached.block)];
    if (attached.folded) {
      const auto free = std::count(block.active_set, block.active_set + block.rows, std::int8_t{0});
      const FactorFlops flops = spring_flops(block, free, attached.other < 0 ? 1 : 2);
      node.springs.factor += flops.factor;
      node.springs.solve += flops.solve;
      continue;
    }
    for (int row = 0; row < block.rows; ++row) {
      if (block.active_set[row] != 0) continue;
      rows_[node.first_row + index(node.n_rows++)] = {&attached, row};
    }
  }
  if (node.folds || node.n_rows != node.counted_rows) count(node);
}

// Of the rows of a joint of the same unit: equal softness for equal shares among redundant rows, so
// that neither the units nor the axes of the scene matter.
double SaddleLdlt::mean_mobility(const Block& block, int row) const {
  const bool moves = row < block.position_rows;
  const int first = moves ? 0 : block.position_rows;
  const int end = moves ? block.position_rows : block.rows;
  double sum = 0.0;
  for (int i = first; i < end; ++i) {
    sum += mobility_of(block, i, inverse_mass_);
  }
  return sum / (end - first);
}

void SaddleLdlt::soften(const Node& node, std::span<const Block> blocks, double share) {
  const Factor f = at(node);
  for (int i = 0; i < node.n_rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    f.S[i * node.n_rows + i] += share * mean_mobility(blocks[index(row.attached->block)], row.row);
    // The bound on pivots must lie below the softness: a clamped pivot drops its row.
    f.S_inverse[i] *= share;
  }
}

// Clamping a pivot alone leaves the force of redundant rows to the last one in the order. All rows
// of a node with joints alone are softened instead, so that they share it.
void SaddleLdlt::factor_rows(const Node& node, std::span<const Block> blocks, auto rows,
                             const auto& form) {
  const Factor f = at(node);
  form();
  if (softened_ > 0.0) soften(node, blocks, softened_);
  if (!factor_ldlt(f.S, rows, f.S_inverse)) return;
  held_ = true;
  if (node.has_bounds || softened_ > 0.0) return;
  form();
  soften(node, blocks, kSoftened);
  factor_ldlt(f.S, rows, f.S_inverse);
}

void SaddleLdlt::factor_leaf(Node& node, std::span<const Block> blocks) {
  with_known(node.n_rows, [&](auto rows) {
    with_known_width(node, [&](auto n) { factor_leaf(node, blocks, rows, n); });
  });
}

void SaddleLdlt::factor_leaf(Node& node, std::span<const Block> blocks, auto rows, auto n) {
  const Factor f = at(node);
  int* first = first_filled_.data() + node.first_coupled;
  std::fill(first, first + node.coupled, rows);
  if (rows == 0) return;
  const auto form = [&] {
    set_zero(f.Z, rows * n);
    const InverseMass& inverse = inverse_mass_[index(node.body)];
    for (int i = 0; i < rows; ++i) {
      const Row& row = rows_[node.first_row + index(i)];
      const Attached& attached = *row.attached;
      const Block& block = blocks[index(attached.block)];
      Vec6 of_pin;
      const double* J = gradient(block, row.row, attached.is_a, of_pin);
      weigh(inverse, J, f.V + 6 * i);
      for (int j = 0; j <= i; ++j) f.S[i * rows + j] = dot6(J, f.V + 6 * j);
      f.S_inverse[i] = kLeastPivot * f.S[i * rows + i];
      f.S[i * rows + i] += block.softness[row.row];
      if (attached.other < 0) continue;
      const double* J_other = gradient(block, row.row, !attached.is_a, of_pin);
      std::copy(J_other, J_other + 6, f.Z + i * n + 6 * attached.other);
      first[attached.other] = std::min(first[attached.other], i);
    }
  };
  factor_rows(node, blocks, rows, form);
  solve_lower(f.S, rows, n, f.Z);
}

void SaddleLdlt::factor_general(Node& node, std::span<const Block> blocks) {
  with_known_width(node, [&](auto n) { factor_general(node, blocks, n); });
}

void SaddleLdlt::factor_general(Node& node, std::span<const Block> blocks, auto n) {
  const Factor f = at(node);
  double* U = values_.data() + node.update;
  set_zero(U, n * n);
  set_zero(f.Y, 6 * n);
  Square6& A = *reinterpret_cast<Square6*>(f.A);
  set_zero(f.A, 36);
  add_inertia(node, A);
  for (std::size_t c = 0; c < node.n_children; ++c) {
    add_left(nodes_[index(children_[node.first_child + c])], A, f.Y, U, n);
  }
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const Attached& attached = attached_[node.first_attached + k];
    if (!attached.folded) continue;
    SpringTarget to{.A = A};
    if (attached.other >= 0) {
      const std::size_t at = index(6 * attached.other);
      to.B = f.Y + at;
      to.U = U + at * index(n) + at;
      to.stride = index(n);
    }
    add_springs(blocks[index(attached.block)], attached.is_a, to);
  }
  std::fill(f.A_inverse, f.A_inverse + 6, 0.0);
  factor_ldlt(f.A, Known<6>{}, f.A_inverse);
  solve_lower(f.A, Known<6>{}, n, f.Y);
  add_gram(f.Y, f.A_inverse, Known<6>{}, -1.0, n, U);
  if (node.n_rows > 0) eliminate_rows(node, blocks);
}

void SaddleLdlt::eliminate_rows(Node& node, std::span<const Block> blocks) {
  const int rows = node.n_rows;
  const int n = width(node);
  const Factor f = at(node);
  const auto form = [&] {
    set_zero(f.Z, rows * n);
    for (int i = 0; i < rows; ++i) {
      const Row& row = rows_[node.first_row + index(i)];
      const Attached& attached = *row.attached;
      const Block& block = blocks[index(attached.block)];
      double* V = f.V + 6 * i;
      Vec6 of_pin;
      const double* J = gradient(block, row.row, attached.is_a, of_pin);
      std::copy(J, J + 6, V);
      solve_lower(f.A, Known<6>{}, Known<1>{}, V);
      double weighted[6];
      for (int j = 0; j < 6; ++j) weighted[j] = f.A_inverse[j] * V[j];
      for (int j = 0; j <= i; ++j) f.S[i * rows + j] = dot6(weighted, f.V + 6 * j);
      f.S[i * rows + i] += block.softness[row.row];
      double on_body[6];
      weigh(inverse_mass_[index(node.body)], J, on_body);
      f.S_inverse[i] = kLeastPivot * dot6(J, on_body);
      double* Z = f.Z + i * n;
      if (attached.other >= 0) {
        const double* J_other = gradient(block, row.row, !attached.is_a, of_pin);
        std::copy(J_other, J_other + 6, Z + 6 * attached.other);
      }
      for (int j = 0; j < 6; ++j) subtract_row(f.Y + j * n, weighted[j], n, Z);
    }
  };
  factor_rows(node, blocks, rows, form);
  solve_lower(f.S, rows, n, f.Z);
  add_gram(f.Z, f.S_inverse, rows, 1.0, n, values_.data() + node.update);
}

}  // namespace substep
