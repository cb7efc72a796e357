#include "core/solver/saddle_ldlt.hpp"

#include <utility>

#include "core/solver/body_products.hpp"
#include "core/solver/dense_ldlt.hpp"

namespace substep {

// One node. v is the velocity of its body, x the impulses of its rows, p the velocities of the
// coupled later bodies:
//   A v - J^T x + B p = g
//   J v + s x + N p   = -w          (N: the rows' gradients on p)
//   B^T v - N^T x + C p = ...
// With A = L D L^T and S = s + J A^-1 J^T, the Schur complement on p is
//   C - B^T A^-1 B + (N - J A^-1 B)^T S^-1 (N - J A^-1 B)
// with the right-hand side
//   - B^T A^-1 g - (N - J A^-1 B)^T S^-1 (w + J A^-1 g).
// Backwards  x = -S^-1 (w + J A^-1 g + (N - J A^-1 B) p),   v = A^-1 (g + J^T x - B p).

void SaddleLdlt::touch(std::size_t block) {
  nodes_[index(node_of_block_[block])].dirty = true;
  factored_ = false;
}

// Momenta from rows that are not unknowns: J^T x of active rows, -J^T w/s of folded ones.
void SaddleLdlt::set_momenta(std::span<const Block> blocks) {
  for (const int i : pushed_) v_[index(i)].setZero();
  for (const int i : pushed_) {
    const Node& node = nodes_[index(i)];
    if (node.kind == NodeKind::kArticulated) continue;
    for (std::size_t k = 0; k < node.n_attached; ++k) {
      const Attached& attached = attached_[node.first_attached + k];
      const Block& block = blocks[index(attached.block)];
      const double* w = w_.data() + index(attached.block) * kMaxRows;
      double x[kMaxRows];
      if (block.has_point_rows) {  // no row is ever active
        if (!attached.folded) continue;
        for (int row = 0; row < 3; ++row) x[row] = -w[row] / block.softness[row];
        for (int row = 3; row < block.rows; ++row) x[row] = -w[row] / block.softness[row];
        push(block, x, of_body(block.a), of_body(block.b));
        continue;
      }
      if (block.rows == 1 && block.active_set[0] == 0 && !attached.folded) continue;
      bool pushes = attached.folded;
      for (int row = 0; row < block.rows; ++row) {
        const bool active = block.active_set[row] != 0;
        x[row] = active            ? block.impulse[row]
                 : attached.folded ? -w[row] / block.softness[row]
                                   : 0.0;
        pushes = pushes || x[row] != 0.0;
      }
      if (!pushes) continue;
      push(block, x, of_body(block.a), of_body(block.b));
    }
  }
}

Vec6* SaddleLdlt::of_body(int body) {
  return body < 0 ? nullptr : &v_[index(order_.position(body))];
}

bool SaddleLdlt::factor_node(Node& node, const System& system) {
  if (node.kind != NodeKind::kArticulated) gather_rows(node, system.blocks);
  flops_ += node.flops.factor;
  if (static_cast<double>(flops_) > system.limits.work) return false;
  node.dirty = false;
  if (node.parent >= 0) nodes_[index(node.parent)].dirty = true;
  const InverseMass& inverse = inverse_mass_[index(node.body)];
  if (node.kind == NodeKind::kLeaf) {
    factor_leaf(node, system.blocks);
  } else if (node.kind == NodeKind::kGeneral) {
    factor_general(node, system.blocks);
  } else if (node.carried != nullptr) {
    node.joint->eliminate(inverse, *node.carried);
  } else {
    Square6 sum;
    sum_carried(node, sum);
    node.joint->eliminate(inverse, sum);
  }
  return true;
}

void SaddleLdlt::forward(const Node& node) {
  double* g = v_[position(node)].data();
  const int* coupled = coupled_.data() + node.first_coupled;
  const int n = width(node);
  const Factor f = at(node);
  double weighted[6];  // D^-1 L^-1 g; leaf: g
  copy6(g, weighted);
  if (node.kind == NodeKind::kGeneral) {
    solve_lower(f.A, Known<6>{}, Known<1>{}, weighted);
    copy6(weighted, g);
    for (int j = 0; j < 6; ++j) weighted[j] *= f.A_inverse[j];
    for (int s = 0; s < node.coupled; ++s) {
      double* to = v_[index(coupled[s])].data();
      Pair left[3];
      for (int p = 0; p < 3; ++p) left[p] = load_pair(to + 2 * p);
      for (int j = 0; j < 6; ++j) {
        for (int p = 0; p < 3; ++p) {
          left[p] -= weighted[j] * load_pair(f.Y + j * n + 6 * s + 2 * p);
        }
      }
      for (int p = 0; p < 3; ++p) store_pair(left[p], to + 2 * p);
    }
  }
  if (node.n_rows == 0) return;
  with_known(node.n_rows, [&](auto rows) {
    with_known_width(node, [&](auto m) { forward_rows(node, f, rows, m, weighted); });
  });
}

void SaddleLdlt::forward_rows(const Node& node, const Factor& f, auto rows, auto n,
                              const double* weighted) {
  const int* coupled = coupled_.data() + node.first_coupled;
  const int* first = first_filled_.data() + node.first_coupled;
  double* c = c_.data() + node.first_row;
  for (int i = 0; i < rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    c[i] = w_[index(row.attached->block) * kMaxRows + index(row.row)] + dot6(f.V + 6 * i, weighted);
  }
  solve_lower(f.S, rows, Known<1>{}, c);
  for (int i = 0; i < rows; ++i) {
    const double k = f.S_inverse[i] * c[i];
    for (int s = 0; 6 * s < n; ++s) {
      if (i < first[s]) continue;
      const double* z = f.Z + i * n + 6 * s;
      double* to = v_[index(coupled[s])].data();
      for (int p = 0; p < 6; p += 2) store_pair(load_pair(to + p) - k * load_pair(z + p), to + p);
    }
  }
}

void SaddleLdlt::backward(const Node& node, std::span<Block> blocks) {
  double* v = v_[position(node)].data();
  const int* coupled = coupled_.data() + node.first_coupled;
  const Factor f = at(node);
  double change[6];  // D^-1 L^-1 (g + J^T x - B p), then of the velocity
  if (node.kind == NodeKind::kLeaf) {
    weigh(inverse_mass_[index(node.body)], v, change);
  } else {
    copy6(v, change);
  }
  with_known(node.n_rows, [&](auto rows) {
    with_known_width(node, [&](auto m) { backward_rows(node, f, rows, m, blocks, change); });
  });
  if (node.kind == NodeKind::kGeneral) {
    const int n = width(node);
    for (int s = 0; s < node.coupled; ++s) {
      const double* p = v_[index(coupled[s])].data();
      for (int j = 0; j < 6; ++j) change[j] -= dot6(f.Y + j * n + 6 * s, p);
    }
    for (int j = 0; j < 6; ++j) change[j] *= f.A_inverse[j];
    solve_upper(f.A, Known<6>{}, change);
  }
  copy6(change, v);
}

void SaddleLdlt::backward_rows(const Node& node, const Factor& f, auto rows, auto n,
                               std::span<Block> blocks, double* change) {
  const int* coupled = coupled_.data() + node.first_coupled;
  const int* first = first_filled_.data() + node.first_coupled;
  double* x = c_.data() + node.first_row;
  for (int i = 0; i < rows; ++i) {
    double sum = x[i];
    for (int s = 0; 6 * s < n; ++s) {
      if (i >= first[s]) sum += dot6(f.Z + i * n + 6 * s, v_[index(coupled[s])].data());
    }
    x[i] = -(f.S_inverse[i] * sum);
  }
  solve_upper(f.S, rows, x);
  for (int i = 0; i < rows; ++i) subtract_row(f.V + 6 * i, -x[i], Known<6>{}, change);
  for (int i = 0; i < rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    blocks[index(row.attached->block)].impulse[row.row] = x[i];
  }
}

// Each node is factored just before its forward solve, so that the two overlap in the pipeline.
void SaddleLdlt::solve(const System& system) {
  if (!std::exchange(factored_, true)) ++factorisations_;
  set_momenta(system.blocks);
  for (Node& node : nodes_) {
    if (node.dirty && !factor_node(node, system)) return;
    if (node.kind == NodeKind::kArticulated) {
      node.joint->forward(node.pushed ? v_[position(node)].data() : nullptr, node.handed_to);
    } else {
      forward(node);
    }
    flops_ += node.flops.solve;
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.kind == NodeKind::kArticulated) {
      node.joint->backward(node.parent_velocity, v_[i].data());
    } else {
      backward(node, system.blocks);
    }
    const auto body = index(node.body);
    system.u[body] = u_star_[body] + v_[i];
  }
  find_spring_impulses(system.blocks, false);
}

void SaddleLdlt::find_impulses(std::span<Block> blocks) {
  if (!refined_) find_skipped_impulses(blocks);
}

void SaddleLdlt::find_skipped_impulses(std::span<Block> blocks) {
  for (const Node& node : nodes_) {
    if (node.kind != NodeKind::kArticulated) continue;
    node.joint->find_impulse(node.parent_velocity,
                             blocks[index(attached_[node.first_attached].block)]);
  }
  find_spring_impulses(blocks, true);
}

void SaddleLdlt::find_spring_impulses(std::span<Block> blocks, bool of_pins) {
  if (!any_folded_) return;
  for (const Attached& attached : attached_) {
    if (!attached.folded) continue;
    Block& block = blocks[index(attached.block)];
    if (block.has_point_rows != of_pins) continue;
    spring_impulses(w_.data() + index(attached.block) * kMaxRows, of_body(block.a),
                    of_body(block.b), block);
  }
}

}  // namespace substep
