#include "core/solver/saddle_ldlt.hpp"

#include <algorithm>

#include "core/solver/dense_ldlt.hpp"
#include "core/solver/flops.hpp"

namespace substep {

// One node. Its body has the velocity v, the rows at it the impulses x, the later bodies that it is
// coupled to the velocities p:
//   A v - J^T x + B p = g
//   J v + s x + N p   = -w          (N: the rows' gradients on p)
//   B^T v - N^T x + C p = ...
// With A = L D L^T and S = s + J A^-1 J^T, what is left on p is
//   C - B^T A^-1 B + (N - J A^-1 B)^T S^-1 (N - J A^-1 B)
// and on its right-hand side
//   - B^T A^-1 g - (N - J A^-1 B)^T S^-1 (w + J A^-1 g).
// Backwards  x = -S^-1 (w + J A^-1 g + (N - J A^-1 B) p),   v = A^-1 (g + J^T x - B p).

namespace {

// Exact rows that are redundant on the body of their node, as in closed loops of exact joints, need
// not be redundant in the whole. They are softened by this much of J A^-1 J^T: as much is wrong
// with the answer, and rounding makes as much again.
constexpr double kLeastPivot = 1e-8;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

const double (&gradient(const Block& block, int row, bool of_a))[6] {
  return of_a ? block.J_a[row] : block.J_b[row];
}

double dot6(const double* a, const double* b) {
  return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// Mt^-1 f.
void weigh(const InverseMass& mass, const double* f, double* out) {
  for (int i = 0; i < 3; ++i) {
    out[i] = mass.linear * f[i];
    out[3 + i] = mass.angular(i, 0) * f[3] + mass.angular(i, 1) * f[4] + mass.angular(i, 2) * f[5];
  }
}

}  // namespace

Square6& SaddleLdlt::square(std::size_t at) {
  return *reinterpret_cast<Square6*>(values_.data() + at);
}

SaddleLdlt::Factor SaddleLdlt::at(const Node& node) {
  const std::size_t w = index(width(node));
  const std::size_t r = index(node.most_rows);
  Factor f;
  f.A = values_.data() + node.values;
  f.A_inverse = f.A + 36;
  f.Y = f.A_inverse + 6;
  f.V = f.Y + 6 * w;
  f.S = f.V + 6 * r;
  f.S_inverse = f.S + r * r;
  f.Z = f.S_inverse + r;
  return f;
}

void SaddleLdlt::touch(std::size_t block) { nodes_[index(node_of_block_[block])].dirty = true; }

void SaddleLdlt::count(Node& node) {
  const std::int64_t n = width(node);
  const std::int64_t rows = node.n_rows;
  for (std::size_t c = 0; c < node.n_children; ++c) {
    const std::int64_t handed = width(nodes_[index(children_[node.first_child + c])]);
    flops_ += handed * (handed + 6) / 2;
  }
  if (node.way == Way::kArticulated) {
    const Attached& attached = attached_[node.first_attached];
    flops_ += ArticulatedJoint::factor_flops(keys_[index(attached.block)].rows);
    node.solve_flops = ArticulatedJoint::solve_flops(keys_[index(attached.block)].rows);
    return;
  }
  const std::int64_t gram = n * (n + 6);  // of one row of Y or Z: two flops on half a square
  const std::int64_t to_general = node.way == Way::kGeneral ? 1 : 0;
  flops_ += to_general * (ldlt_flops(6) + unit_triangle_flops(6, n + rows) + 6 * gram +
                          product_flops(rows, 6, n) + 2 * product_flops(node.n_folded, 6, 9)) +
            product_flops(rows, 6, rows + 6) / 2 + ldlt_flops(rows) + unit_triangle_flops(rows, n) +
            rows * gram;
  node.solve_flops = 2 * (unit_triangle_flops(6) + unit_triangle_flops(rows) +
                          product_flops(rows, 6, 2) + product_flops(rows + 6, n, 1));
}

void SaddleLdlt::factor_node(Node& node, std::span<const Block> blocks) {
  switch (node.way) {
    case Way::kArticulated:
      return factor_articulated(node);
    case Way::kBare:
      return factor_bare(node, blocks);
    case Way::kGeneral:
      return factor_general(node, blocks);
  }
}

void SaddleLdlt::add_inertia(const Node& node, Square6& A) const {
  const InverseMass& inverse = inverse_mass_[index(node.body)];
  double I[3][3];
  inverse_of(inverse.angular, I);
  const double mass = 1.0 / inverse.linear;
  for (int i = 0; i < 3; ++i) {
    A[i][i] += mass;
    A[3 + i][3 + i] += I[i][i];
    for (int j = 0; j < i; ++j) {
      A[3 + i][3 + j] += I[i][j];
      A[3 + j][3 + i] += I[i][j];
    }
  }
}

void SaddleLdlt::add_children(const Node& node, Square6& A, double* B, double* U) const {
  const std::size_t n = index(width(node));
  for (std::size_t c = 0; c < node.n_children; ++c) {
    const Node& child = nodes_[index(children_[node.first_child + c])];
    const std::size_t m = index(width(child));
    const int* place = place_.data() + child.first_coupled;
    const double* from = values_.data() + child.update;
    for (int s = 0; s < child.coupled; ++s) {
      for (int t = s; t < child.coupled; ++t) {
        const double* block = from + index(6 * s) * m + index(6 * t);
        if (t == 0) {
          for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j < 6; ++j) A[i][j] += block[i * m + j];
          }
          continue;
        }
        double* to = (s == 0 ? B : U + index(6 * place[s]) * n) + index(6 * place[t]);
        for (std::size_t i = 0; i < 6; ++i) {
          for (std::size_t j = 0; j < 6; ++j) to[i * n + j] += block[i * m + j];
        }
      }
    }
  }
}

void SaddleLdlt::factor_articulated(Node& node) {
  ArticulatedJoint& joint = joints_[node.joint];
  const int* children = children_.data() + node.first_child;
  Square6 sum = {};
  const Square6* carried = &sum;
  if (node.n_children == 1 && nodes_[index(children[0])].way == Way::kArticulated) {
    carried = &square(nodes_[index(children[0])].update);
  } else {
    for (std::size_t c = 0; c < node.n_children; ++c) {
      const Node& child = nodes_[index(children[c])];
      Square6 shifted;
      const Square6* from = &square(child.update);
      if (child.way != Way::kArticulated) {
        load(*from).shift(joint.pivot(), shifted);
        from = &shifted;
      }
      for (int i = 0; i < 6; ++i) {
        for (int j = i; j < 6; ++j) sum[i][j] += (*from)[i][j];
      }
    }
  }
  Square6* to_parent = node.parent < 0 ? nullptr : &square(node.update);
  joint.eliminate(inverse_mass_[index(node.body)], *carried, to_parent);
  if (to_parent == nullptr || nodes_[index(node.parent)].way == Way::kArticulated) return;
  for (int i = 1; i < 6; ++i) {
    for (int j = 0; j < i; ++j) (*to_parent)[i][j] = (*to_parent)[j][i];
  }
}

void SaddleLdlt::gather_rows(Node& node, std::span<const Block> blocks) {
  node.n_rows = 0;
  node.n_folded = 0;
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const Attached& attached = attached_[node.first_attached + k];
    const Block& block = blocks[index(attached.block)];
    for (int row = 0; row < block.rows; ++row) {
      if (block.tight[row] != 0) continue;
      if (attached.folded) {
        ++node.n_folded;
        continue;
      }
      rows_[node.first_row + index(node.n_rows++)] = {static_cast<int>(k), row};
    }
  }
}

void SaddleLdlt::factor_bare(Node& node, std::span<const Block> blocks) {
  gather_rows(node, blocks);
  const int rows = node.n_rows;
  const int n = width(node);
  const Factor f = at(node);
  double* U = values_.data() + node.update;
  std::fill(U, U + n * n, 0.0);
  if (rows == 0) return;
  std::fill(f.Z, f.Z + rows * n, 0.0);
  const InverseMass& inverse = inverse_mass_[index(node.body)];
  for (int i = 0; i < rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    const Attached& attached = attached_[node.first_attached + index(row.attached)];
    const Block& block = blocks[index(attached.block)];
    const auto& J = gradient(block, row.row, attached.is_a);
    weigh(inverse, J, f.V + 6 * i);
    for (int j = 0; j <= i; ++j) f.S[i * rows + j] = dot6(J, f.V + 6 * j);
    f.S_inverse[i] = kLeastPivot * f.S[i * rows + i];
    f.S[i * rows + i] += block.softness[row.row];
    if (attached.other < 0) continue;
    const auto& J_other = gradient(block, row.row, !attached.is_a);
    std::copy(J_other, J_other + 6, f.Z + i * n + 6 * attached.other);
  }
  factor_ldlt(f.S, rows, f.S_inverse);
  solve_lower(f.S, rows, n, f.Z);
  add_gram(f.Z, rows, f.S_inverse, 1.0, n, U);
}

void SaddleLdlt::factor_general(Node& node, std::span<const Block> blocks) {
  const int n = width(node);
  const Factor f = at(node);
  double* U = values_.data() + node.update;
  std::fill(U, U + n * n, 0.0);
  std::fill(f.Y, f.Y + 6 * n, 0.0);
  Square6 A = {};
  add_inertia(node, A);
  add_children(node, A, f.Y, U);
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const Attached& attached = attached_[node.first_attached + k];
    if (attached.folded) fold(node, blocks[index(attached.block)], attached, A, f.Y, U);
  }
  for (std::size_t i = 0; i < 6; ++i) std::copy(A[i], A[i] + 6, f.A + 6 * i);
  std::fill(f.A_inverse, f.A_inverse + 6, 0.0);
  factor_ldlt(f.A, 6, f.A_inverse);
  solve_lower(f.A, 6, n, f.Y);
  add_gram<6>(f.Y, f.A_inverse, -1.0, n, U);
  gather_rows(node, blocks);
  if (node.n_rows > 0) eliminate_rows(node, blocks);
}

// J^T s^-1 J of the free rows: on the node's body, between it and the other, and on the other.
void SaddleLdlt::fold(const Node& node, const Block& block, const Attached& attached, Square6& A,
                      double* B, double* U) const {
  const std::size_t n = index(width(node));
  double* B_other = attached.other < 0 ? nullptr : B + 6 * attached.other;
  double* U_other =
      attached.other < 0 ? nullptr : U + index(6 * attached.other) * n + index(6 * attached.other);
  for (int row = 0; row < block.rows; ++row) {
    if (block.tight[row] != 0) continue;
    const double k = 1.0 / block.softness[row];
    const auto& J = gradient(block, row, attached.is_a);
    for (std::size_t i = 0; i < 6; ++i) {
      const double f = k * J[i];
      for (std::size_t j = 0; j < 6; ++j) A[i][j] += f * J[j];
    }
    if (attached.other < 0) continue;
    const auto& J_other = gradient(block, row, !attached.is_a);
    for (std::size_t i = 0; i < 6; ++i) {
      const double f = k * J[i];
      const double f_other = k * J_other[i];
      for (std::size_t j = 0; j < 6; ++j) {
        B_other[i * n + j] += f * J_other[j];
        U_other[i * n + j] += f_other * J_other[j];
      }
    }
  }
}

void SaddleLdlt::eliminate_rows(Node& node, std::span<const Block> blocks) {
  const int rows = node.n_rows;
  const int n = width(node);
  const Factor f = at(node);
  std::fill(f.Z, f.Z + rows * n, 0.0);
  for (int i = 0; i < rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    const Attached& attached = attached_[node.first_attached + index(row.attached)];
    const Block& block = blocks[index(attached.block)];
    double* V = f.V + 6 * i;
    const auto& J = gradient(block, row.row, attached.is_a);
    std::copy(J, J + 6, V);
    solve_lower(f.A, 6, 1, V);
    double weighted[6];
    for (int j = 0; j < 6; ++j) weighted[j] = f.A_inverse[j] * V[j];
    for (int j = 0; j <= i; ++j) f.S[i * rows + j] = dot6(weighted, f.V + 6 * j);
    f.S[i * rows + i] += block.softness[row.row];
    double on_body[6];
    weigh(inverse_mass_[index(node.body)], J, on_body);
    f.S_inverse[i] = kLeastPivot * dot6(J, on_body);
    double* Z = f.Z + i * n;
    if (attached.other >= 0) {
      const auto& J_other = gradient(block, row.row, !attached.is_a);
      std::copy(J_other, J_other + 6, Z + 6 * attached.other);
    }
    for (int j = 0; j < 6; ++j) subtract_row(f.Y + j * n, weighted[j], n, Z);
  }
  factor_ldlt(f.S, rows, f.S_inverse);
  solve_lower(f.S, rows, n, f.Z);
  add_gram(f.Z, rows, f.S_inverse, 1.0, n, values_.data() + node.update);
}

// ----------------------------------------------------------------------------------------- solve

// What acts on the bodies besides the rows that are unknowns: tight rows give J^T x, folded ones
// -J^T w/s.
void SaddleLdlt::set_momenta(std::span<const Block> blocks) {
  for (Vec6& g : v_) g.setZero();
  for (const Node& node : nodes_) {
    if (node.way == Way::kArticulated) {
      const bool at_pivot = node.parent >= 0 && nodes_[index(node.parent)].way == Way::kArticulated;
      joints_[node.joint].refer_to(at_pivot ? joints_[nodes_[index(node.parent)].joint].pivot()
                                            : nullptr);
      continue;
    }
    for (std::size_t k = 0; k < node.n_attached; ++k) {
      const Attached& attached = attached_[node.first_attached + k];
      const Block& block = blocks[index(attached.block)];
      const double* w = w_.data() + index(attached.block) * kMaxRows;
      for (int row = 0; row < block.rows; ++row) {
        double x = 0.0;
        if (block.tight[row] != 0) {
          x = block.impulse[row];
        } else if (attached.folded) {
          x = -w[row] / block.softness[row];
        }
        if (x == 0.0) continue;
        const auto add = [&](int body, const double(&J)[6]) {
          if (body < 0) return;
          Vec6& g = v_[index(order_.position(body))];
          for (int j = 0; j < 6; ++j) g[j] += J[j] * x;
        };
        add(block.a, block.J_a[row]);
        add(block.b, block.J_b[row]);
      }
    }
  }
}

// An articulated node is handed momentum and asked for its velocity at its pivot by articulated
// children, at its centre by others.
double* SaddleLdlt::momentum(int node) {
  const Node& to = nodes_[index(node)];
  return to.way == Way::kArticulated ? joints_[to.joint].momentum() : v_[index(node)].data();
}

const double* SaddleLdlt::velocity(int node) const {
  const Node& of = nodes_[index(node)];
  return of.way == Way::kArticulated ? joints_[of.joint].velocity() : v_[index(node)].data();
}

void SaddleLdlt::forward(const Node& node) {
  double* g = v_[static_cast<std::size_t>(&node - nodes_.data())].data();
  const int* coupled = coupled_.data() + node.first_coupled;
  if (node.way == Way::kArticulated) {
    return joints_[node.joint].forward(g, node.parent < 0 ? nullptr : momentum(node.parent));
  }
  const int n = width(node);
  const Factor f = at(node);
  double weighted[6];  // D^-1 L^-1 g; bare: g
  if (node.way == Way::kBare) {
    std::copy(g, g + 6, weighted);
  } else {
    solve_lower(f.A, 6, 1, g);
    for (int j = 0; j < 6; ++j) weighted[j] = f.A_inverse[j] * g[j];
    for (int s = 0; s < node.coupled; ++s) {
      Vec6& to = v_[index(coupled[s])];
      for (int j = 0; j < 6; ++j) {
        subtract_row(f.Y + j * n + 6 * s, weighted[j], 6, to.data());
      }
    }
  }
  double* c = c_.data() + node.first_row;
  for (int i = 0; i < node.n_rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    const int block = attached_[node.first_attached + index(row.attached)].block;
    c[i] = w_[index(block) * kMaxRows + index(row.row)] + dot6(f.V + 6 * i, weighted);
  }
  solve_lower(f.S, node.n_rows, 1, c);
  for (int i = 0; i < node.n_rows; ++i) {
    const double k = f.S_inverse[i] * c[i];
    for (int s = 0; s < node.coupled; ++s) {
      subtract_row(f.Z + i * n + 6 * s, k, 6, v_[index(coupled[s])].data());
    }
  }
}

void SaddleLdlt::backward(const Node& node, std::span<Block> blocks) {
  double* v = v_[static_cast<std::size_t>(&node - nodes_.data())].data();
  const int* coupled = coupled_.data() + node.first_coupled;
  if (node.way == Way::kArticulated) {
    const int block = attached_[node.first_attached].block;
    return joints_[node.joint].backward(node.parent < 0 ? nullptr : velocity(node.parent), v,
                                        blocks[index(block)].impulse);
  }
  const int n = width(node);
  const Factor f = at(node);
  double* x = c_.data() + node.first_row;
  for (int i = 0; i < node.n_rows; ++i) {
    double sum = x[i];
    for (int s = 0; s < node.coupled; ++s) {
      sum += dot6(f.Z + i * n + 6 * s, v_[index(coupled[s])].data());
    }
    x[i] = -(f.S_inverse[i] * sum);
  }
  solve_upper(f.S, node.n_rows, x);
  if (node.way == Way::kBare) {
    double change[6];
    weigh(inverse_mass_[index(node.body)], v, change);
    for (int i = 0; i < node.n_rows; ++i) subtract_row(f.V + 6 * i, -x[i], 6, change);
    std::copy(change, change + 6, v);
  } else {
    for (int i = 0; i < node.n_rows; ++i) subtract_row(f.V + 6 * i, -x[i], 6, v);
    for (int j = 0; j < 6; ++j) {
      for (int s = 0; s < node.coupled; ++s) {
        v[j] -= dot6(f.Y + j * n + 6 * s, v_[index(coupled[s])].data());
      }
      v[j] *= f.A_inverse[j];
    }
    solve_upper(f.A, 6, v);
  }
  for (int i = 0; i < node.n_rows; ++i) {
    const Row& row = rows_[node.first_row + index(i)];
    const int block = attached_[node.first_attached + index(row.attached)].block;
    blocks[index(block)].impulse[row.row] = x[i];
  }
}

// A node is factored just before it is solved forward: neither waits for the other.
void SaddleLdlt::solve(const System& system) {
  set_momenta(system.blocks);
  for (Node& node : nodes_) {
    if (node.dirty) {
      node.dirty = false;
      factor_node(node, system.blocks);
      count(node);
      if (node.parent >= 0) nodes_[index(node.parent)].dirty = true;
    }
    forward(node);
    flops_ += node.solve_flops;
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) backward(nodes_[i], system.blocks);
  std::copy(u_star_.begin(), u_star_.end(), system.u.begin());
  for (std::size_t i = 0; i < nodes_.size(); ++i) system.u[index(nodes_[i].body)] += v_[i];
  for (const Attached& attached : attached_) {
    if (!attached.folded) continue;
    Block& block = system.blocks[index(attached.block)];
    const double* w = w_.data() + index(attached.block) * kMaxRows;
    for (int row = 0; row < block.rows; ++row) {
      if (block.tight[row] != 0) continue;
      double speed = w[row];
      if (block.a >= 0) speed += dot6(block.J_a[row], v_[index(order_.position(block.a))].data());
      if (block.b >= 0) speed += dot6(block.J_b[row], v_[index(order_.position(block.b))].data());
      block.impulse[row] = -speed / block.softness[row];
    }
  }
}

}  // namespace substep
