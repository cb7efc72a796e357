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

// A row is folded if 1/s exceeds what the row sees of its bodies' inertia by at most this: as many
// digits of the inertia are lost.
constexpr double kFold = 1e7;
// Exact rows that are redundant on the body of their node, as in closed loops of exact joints, need
// not be redundant in the whole. They are softened by this much of J A^-1 J^T: as much is wrong
// with the answer, and rounding makes as much again.
constexpr double kLeastPivot = 1e-8;
constexpr int kBareRows = 8;  // more rows are cheaper when folded

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

/// Largest J Mt^-1 J^T that a row can have on one body.
double mobility(const double (&J)[6], const InverseMass& mass) {
  return mass.linear * (J[0] * J[0] + J[1] * J[1] + J[2] * J[2]) +
         mass.angular.trace() * (J[3] * J[3] + J[4] * J[4] + J[5] * J[5]);
}

}  // namespace

void SaddleLdlt::reserve(std::size_t bodies, std::size_t blocks) {
  constexpr std::size_t kCoupled = 4;  // typical of a body
  constexpr std::size_t kRows = 8;
  constexpr std::size_t kWidth = 6 * kCoupled;
  order_.reserve(bodies, blocks);
  keys_.reserve(blocks);
  found_.reserve(blocks);
  nodes_.reserve(bodies);
  node_of_block_.reserve(blocks);
  attached_.reserve(blocks);
  coupled_.reserve(bodies * kCoupled);
  place_.reserve(bodies * kCoupled);
  children_.reserve(bodies);
  rows_.reserve(blocks * kMaxRows);
  joints_.reserve(bodies);
  values_.reserve(bodies * (42 + 6 * kWidth + kRows * (7 + kRows + kWidth) + kWidth * kWidth));
  inverse_mass_.reserve(bodies);
  u_star_.reserve(bodies);
  w_.reserve(blocks * kMaxRows);
  v_.reserve(bodies);
  c_.reserve(blocks * kMaxRows);
}

bool SaddleLdlt::foldable(const Block& block, const System& system) const {
  for (int row = 0; row < block.rows; ++row) {
    const double s = block.softness[row];
    if (s == 0.0) return false;
    double most = 0.0;
    if (block.a >= 0) most += mobility(block.J_a[row], system.inverse_mass[index(block.a)]);
    if (block.b >= 0) most += mobility(block.J_b[row], system.inverse_mass[index(block.b)]);
    if (!(most <= kFold * s)) return false;
  }
  return true;
}

// ------------------------------------------------------------------------------------- structure

void SaddleLdlt::begin(const System& system) {
  flops_ = 0;
  inverse_mass_.assign(system.inverse_mass.begin(), system.inverse_mass.end());
  u_star_.assign(system.u.begin(), system.u.end());
  if (!layout_is_the_same(system)) lay_out(system);
  w_.resize(system.blocks.size() * kMaxRows);
  for (Node& node : nodes_) {
    node.dirty = true;
    if (node.way == Way::kArticulated) {
      const Attached& attached = attached_[node.first_attached];
      joints_[node.joint].read(system.blocks[index(attached.block)], attached.is_a, u_star_);
    } else {
      read_rows(node, system);
    }
  }
}

void SaddleLdlt::read_rows(const Node& node, const System& system) {
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const int i = attached_[node.first_attached + k].block;
    const Block& block = system.blocks[index(i)];
    double* w = w_.data() + index(i) * kMaxRows;
    row_speeds(block, system.u, w);
    for (int row = 0; row < block.rows; ++row) w[row] += block.bias[row];
  }
}

bool SaddleLdlt::layout_is_the_same(const System& system) {
  found_.clear();
  for (const Block& block : system.blocks) found_.push_back({block.a, block.b, block.rows});
  const bool other_graph = order_.update(system.blocks, system.u.size());
  if (other_graph || found_ != keys_) {
    std::swap(found_, keys_);
    return false;
  }
  for (const Node& node : nodes_) {
    if (node.way != Way::kGeneral) continue;
    for (std::size_t k = 0; k < node.n_attached; ++k) {
      const Attached& attached = attached_[node.first_attached + k];
      if (attached.foldable != foldable(system.blocks[index(attached.block)], system)) return false;
    }
  }
  return true;
}

void SaddleLdlt::lay_out(const System& system) {
  nodes_.clear();
  coupled_.clear();
  for (const int body : order_.order()) {
    Node node;
    node.body = body;
    node.first_coupled = coupled_.size();
    for (const int other : order_.coupled(body)) coupled_.push_back(order_.position(other));
    node.coupled = static_cast<int>(coupled_.size() - node.first_coupled);
    if (node.coupled > 0) node.parent = coupled_[node.first_coupled];
    nodes_.push_back(node);
  }
  // What a node leaves goes to the first of its coupled bodies, and with it to its coupled bodies.
  place_.resize(coupled_.size());
  for (const Node& node : nodes_) {
    if (node.parent < 0) continue;
    Node& parent = nodes_[index(node.parent)];
    ++parent.n_children;
    const int* own = coupled_.data() + node.first_coupled;
    const int* others = coupled_.data() + parent.first_coupled;
    int at = 0;
    place_[node.first_coupled] = -1;
    for (int i = 1; i < node.coupled; ++i) {
      while (others[at] != own[i]) ++at;
      place_[node.first_coupled + index(i)] = at;
    }
  }
  children_.resize(nodes_.size());
  std::size_t first_child = 0;
  for (Node& node : nodes_) {
    node.first_child = first_child;
    first_child += node.n_children;
    node.n_children = 0;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].parent < 0) continue;
    Node& parent = nodes_[index(nodes_[i].parent)];
    children_[parent.first_child + parent.n_children++] = static_cast<int>(i);
  }

  attach(system.blocks);
  joints_.clear();
  std::size_t values = 0;
  std::size_t rows = 0;
  for (Node& node : nodes_) {
    choose_way(node, system);
    const std::size_t w = index(width(node));
    const std::size_t r = index(node.most_rows);
    node.values = values;
    if (node.way != Way::kArticulated) values += 42 + 6 * w + r * (7 + r + w);
    node.update = values;
    values += w * w;
    node.first_row = rows;
    rows += r;
  }
  values_.resize(values);
  rows_.resize(rows);
  c_.resize(rows);
  v_.resize(nodes_.size());
}

void SaddleLdlt::attach(std::span<const Block> blocks) {
  node_of_block_.resize(blocks.size());
  attached_.resize(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    const int a = block.a < 0 ? -1 : order_.position(block.a);
    const int b = block.b < 0 ? -1 : order_.position(block.b);
    node_of_block_[i] = a < 0 ? b : b < 0 ? a : std::min(a, b);
    ++nodes_[index(node_of_block_[i])].n_attached;
  }
  std::size_t first = 0;
  for (Node& node : nodes_) {
    node.first_attached = first;
    first += node.n_attached;
    node.n_attached = 0;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Node& node = nodes_[index(node_of_block_[i])];
    Attached attached;
    attached.block = static_cast<int>(i);
    attached.is_a = blocks[i].a == node.body;
    const int other = attached.is_a ? blocks[i].b : blocks[i].a;
    if (other >= 0) {
      const int* list = coupled_.data() + node.first_coupled;
      attached.other =
          static_cast<int>(std::find(list, list + node.coupled, order_.position(other)) - list);
    }
    attached_[node.first_attached + node.n_attached++] = attached;
  }
}

void SaddleLdlt::choose_way(Node& node, const System& system) {
  const std::span<const Block> blocks = system.blocks;
  Attached* attached = attached_.data() + node.first_attached;
  const int* children = children_.data() + node.first_child;
  const bool in_tree = std::all_of(children, children + node.n_children,
                                   [&](int child) { return nodes_[index(child)].coupled == 1; });
  if (in_tree && node.n_attached == 1 && blocks[index(attached[0].block)].pinned &&
      node.coupled == (attached[0].other < 0 ? 0 : 1)) {
    node.way = Way::kArticulated;
    node.joint = joints_.size();
    joints_.emplace_back();
    return;
  }
  int rows = 0;
  for (std::size_t k = 0; k < node.n_attached; ++k) rows += blocks[index(attached[k].block)].rows;
  node.way = node.n_children == 0 && rows <= kBareRows ? Way::kBare : Way::kGeneral;
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const Block& block = blocks[index(attached[k].block)];
    attached[k].foldable = foldable(block, system);
    attached[k].folded = node.way == Way::kGeneral && attached[k].foldable;
    if (!attached[k].folded) node.most_rows += block.rows;
  }
}

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

// ---------------------------------------------------------------------------------------- factor

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
  std::copy(A[0], A[0] + 36, f.A);
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
