#include "core/solver/block_ldlt.hpp"

#include <algorithm>
#include <limits>

#include "core/solver/flops.hpp"

namespace substep {

namespace {

/// W = Mt^-1 J^T: 6 x rows.
void weigh(const double (&J)[kMaxRows][6], int rows, const InverseMass& mass,
           double (&W)[6][kMaxRows]) {
  for (int r = 0; r < rows; ++r) {
    for (int i = 0; i < 3; ++i) {
      W[i][r] = mass.linear * J[r][i];
      W[3 + i][r] = mass.angular(i, 0) * J[r][3] + mass.angular(i, 1) * J[r][4] +
                    mass.angular(i, 2) * J[r][5];
    }
  }
}

/// out += J W, rows x cols, from the component `First` on. The innermost loop runs along a row of W
/// and of out, so that compilers can take two columns at a time without touching the order of a
/// sum.
template <int Rows, int Cols, int First>
void add_product(const double (&J)[kMaxRows][6], const double (&W)[6][kMaxRows], double* out) {
  for (int r = 0; r < Rows; ++r) {
    double sum[kMaxRows];
    for (int c = 0; c < Cols; ++c) sum[c] = out[r * Cols + c];
    for (int j = First; j < 6; ++j) {
      for (int c = 0; c < Cols; ++c) sum[c] += J[r][j] * W[j][c];
    }
    for (int c = 0; c < Cols; ++c) out[r * Cols + c] = sum[c];
  }
}

template <int Rows, int First>
void add_product(const double (&J)[kMaxRows][6], const double (&W)[6][kMaxRows], int cols,
                 double* out) {
  switch (cols) {
    case 1:
      return add_product<Rows, 1, First>(J, W, out);
    case 2:
      return add_product<Rows, 2, First>(J, W, out);
    case 3:
      return add_product<Rows, 3, First>(J, W, out);
    case 4:
      return add_product<Rows, 4, First>(J, W, out);
    default:
      return add_product<Rows, 5, First>(J, W, out);
  }
}

template <int First>
void add_product(const double (&J)[kMaxRows][6], int rows, const double (&W)[6][kMaxRows], int cols,
                 double* out) {
  switch (rows) {
    case 1:
      return add_product<1, First>(J, W, cols, out);
    case 2:
      return add_product<2, First>(J, W, cols, out);
    case 3:
      return add_product<3, First>(J, W, cols, out);
    case 4:
      return add_product<4, First>(J, W, cols, out);
    default:
      return add_product<5, First>(J, W, cols, out);
  }
}

/// What two blocks share through one body: out += J_row Mt^-1 J_col^T. Between two pinned blocks
/// the linear part is +-E/m and is written down instead of multiplied out.
void couple(const Block& row, bool row_is_a, const Block& col, bool col_is_a,
            const double (&W)[6][kMaxRows], const InverseMass& mass, double* out) {
  const auto& J = row_is_a ? row.J_a : row.J_b;
  if (row.pinned && col.pinned) {
    const double by_mass = row_is_a == col_is_a ? mass.linear : -mass.linear;
    for (int i = 0; i < 3; ++i) out[i * col.rows + i] += by_mass;
    add_product<3>(J, row.rows, W, col.rows, out);
  } else {
    add_product<0>(J, row.rows, W, col.rows, out);
  }
}

/// out -= Z Y, Z a panel's rows x K, Y a panel's K x cols with `stride` between its rows.
template <int K, int Cols>
void subtract_product(const double* Z, int rows, const double* Y, std::size_t stride, double* out) {
  for (int r = 0; r < rows; ++r) {
    double sum[kMaxRows];
    for (int c = 0; c < Cols; ++c) sum[c] = Z[r * K] * Y[c];
    for (int k = 1; k < K; ++k) {
      const double* y = Y + static_cast<std::size_t>(k) * stride;
      for (int c = 0; c < Cols; ++c) sum[c] += Z[r * K + k] * y[c];
    }
    for (int c = 0; c < Cols; ++c) out[r * Cols + c] -= sum[c];
  }
}

}  // namespace

void BlockLdlt::reserve(std::size_t bodies, std::size_t blocks) {
  constexpr std::size_t kCoupled = 12;  // typical blocks coupled to one
  constexpr std::size_t kArea = kMaxRows * kMaxRows;
  order_.reserve(bodies, blocks);
  nodes_.reserve(blocks);
  coupled_.reserve(blocks * kCoupled);
  updates_.reserve(blocks * kCoupled * kCoupled / 2);
  products_.reserve(blocks * kCoupled);
  diagonals_.reserve(blocks);
  weighted_.reserve(blocks);
  values_.reserve(blocks * kCoupled * kArea);
  contacts_.reserve(blocks * kCoupled * kArea);
  scratch_.reserve(blocks * kArea);
  x_.reserve(blocks * kMaxRows);
  while (on_body_.size() < bodies) on_body_.emplace_back().reserve(32);
}

void BlockLdlt::lay_out(std::span<const Block> blocks) {
  nodes_.clear();
  coupled_.clear();
  updates_.clear();
  products_.clear();
  std::size_t panel = 0;
  std::size_t x = 0;
  std::size_t tallest = 0;
  for (const int block : order_.order()) {
    if (nodes_.size() == order_.joints()) contacts_at_ = panel;
    Node node;
    node.block = block;
    node.rows = blocks[static_cast<std::size_t>(block)].rows;
    node.panel = panel;
    node.x = x;
    node.first_coupled = coupled_.size();
    auto height = static_cast<std::size_t>(node.rows);
    for (const int other : order_.coupled(block)) {
      const int rows = blocks[static_cast<std::size_t>(other)].rows;
      coupled_.push_back({order_.position(other), rows, height});
      height += static_cast<std::size_t>(rows);
    }
    node.n_coupled = coupled_.size() - node.first_coupled;
    panel += height * static_cast<std::size_t>(node.rows);
    x += static_cast<std::size_t>(node.rows);
    tallest = std::max(tallest, height);
    nodes_.push_back(node);
  }
  if (order_.joints() == nodes_.size()) contacts_at_ = panel;
  values_.resize(panel);
  contacts_.resize(panel - contacts_at_);
  scratch_.resize(tallest * kMaxRows);
  x_.resize(x);

  // Where the block (row, col) of A is stored; col is eliminated first.
  const auto place = [&](int row, int col) {
    const Node& node = nodes_[static_cast<std::size_t>(col)];
    if (row == col) return node.panel;
    const auto* first = coupled_.data() + node.first_coupled;
    const auto* at = std::lower_bound(first, first + node.n_coupled, row,
                                      [](const Coupled& c, int r) { return c.node < r; });
    return node.panel + at->offset * static_cast<std::size_t>(node.rows);
  };
  for (Node& node : nodes_) {
    node.first_update = updates_.size();
    for (std::size_t s = 0; s < node.n_coupled; ++s) {
      for (std::size_t t = s; t < node.n_coupled; ++t) {
        updates_.push_back(
            place(coupled_[node.first_coupled + t].node, coupled_[node.first_coupled + s].node));
      }
    }
  }
  diagonals_.resize(blocks.size());
  for (auto& list : on_body_) list.clear();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const int at_i = order_.position(static_cast<int>(i));
    diagonals_[i] = nodes_[static_cast<std::size_t>(at_i)].panel;
    for (const int body : {blocks[i].a, blocks[i].b}) {
      if (body < 0) continue;
      if (on_body_.size() <= static_cast<std::size_t>(body))
        on_body_.resize(static_cast<std::size_t>(body) + 1);
      auto& list = on_body_[static_cast<std::size_t>(body)];
      for (const int other : list) {
        const int at_other = order_.position(other);
        const bool i_is_row = at_i > at_other;
        const int row = i_is_row ? static_cast<int>(i) : other;
        const int col = i_is_row ? other : static_cast<int>(i);
        products_.push_back({row, col, blocks[static_cast<std::size_t>(row)].a == body,
                             blocks[static_cast<std::size_t>(col)].a == body,
                             place(std::max(at_i, at_other), std::min(at_i, at_other))});
      }
      list.push_back(static_cast<int>(i));
    }
  }
  count(blocks);
}

void BlockLdlt::count(std::span<const Block> blocks) {
  cost_ = {};
  const auto couple_flops = [](const Block& row, const Block& col) {
    const bool identity = row.pinned && col.pinned;
    return product_flops(row.rows, identity ? 3 : 6, col.rows) + (identity ? 3 : 0);
  };
  for (const Block& block : blocks) {
    const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
    cost_.form += bodies * (18 * block.rows + couple_flops(block, block));
  }
  for (const Product& product : products_) {
    cost_.form += couple_flops(blocks[static_cast<std::size_t>(product.row_block)],
                               blocks[static_cast<std::size_t>(product.col_block)]);
  }
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const std::int64_t k = nodes_[p].rows;
    std::int64_t below = 0;
    std::int64_t updates = 0;
    for (std::size_t c = nodes_[p].n_coupled; c-- > 0;) {
      const std::int64_t rows = coupled_[nodes_[p].first_coupled + c].rows;
      below += rows;
      updates += product_flops(below, k, rows);
    }
    (p < order_.joints() ? cost_.joints : cost_.contacts) +=
        ldlt_flops(k) + unit_triangle_flops(k, below) + below * k + updates;
    cost_.solve += 2 * (unit_triangle_flops(k) + product_flops(below, k, 1)) + k;
  }
}

void BlockLdlt::form(const System& system) {
  const std::span<const Block> blocks = system.blocks;
  weighted_.resize(blocks.size());
  std::fill(values_.begin(), values_.end(), 0.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    Weighted& W = weighted_[i];
    double* D = values_.data() + diagonals_[i];
    for (int r = 0; r < block.rows; ++r) D[r * block.rows + r] = block.softness[r];
    if (block.a >= 0) {
      const InverseMass& mass = system.inverse_mass[static_cast<std::size_t>(block.a)];
      weigh(block.J_a, block.rows, mass, W.a);
      couple(block, true, block, true, W.a, mass, D);
    }
    if (block.b >= 0) {
      const InverseMass& mass = system.inverse_mass[static_cast<std::size_t>(block.b)];
      weigh(block.J_b, block.rows, mass, W.b);
      couple(block, false, block, false, W.b, mass, D);
    }
  }
  for (const Product& product : products_) {
    const Block& row = blocks[static_cast<std::size_t>(product.row_block)];
    const Block& col = blocks[static_cast<std::size_t>(product.col_block)];
    const Weighted& W = weighted_[static_cast<std::size_t>(product.col_block)];
    const int body = product.col_is_a ? col.a : col.b;
    couple(row, product.row_is_a, col, product.col_is_a, product.col_is_a ? W.a : W.b,
           system.inverse_mass[static_cast<std::size_t>(body)], values_.data() + product.at);
  }
}

void BlockLdlt::begin(const System& system) {
  if (order_.update(system.blocks, system.u.size())) lay_out(system.blocks);
  flops_ = cost_.form + cost_.joints;
  form(system);
  eliminate(0, order_.joints());
  std::copy(values_.begin() + static_cast<std::ptrdiff_t>(contacts_at_), values_.end(),
            contacts_.begin());
}

void BlockLdlt::factor_contacts(std::span<const Block> blocks) {
  flops_ += cost_.contacts;
  std::copy(contacts_.begin(), contacts_.end(),
            values_.begin() + static_cast<std::ptrdiff_t>(contacts_at_));
  for (std::size_t p = order_.joints(); p < nodes_.size(); ++p) {
    const Node& node = nodes_[p];
    double* panel = values_.data() + node.panel;
    const auto cols = static_cast<std::size_t>(node.rows);
    const auto clear_tight_rows = [&](int of_node, std::size_t offset) {
      const Block& block =
          blocks[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(of_node)].block)];
      for (int r = 0; r < block.rows; ++r) {
        if (block.tight[r] == 0) continue;
        double* row = panel + (offset + static_cast<std::size_t>(r)) * cols;
        std::fill(row, row + cols, 0.0);
      }
    };
    clear_tight_rows(static_cast<int>(p), 0);
    std::size_t height = cols;
    for (std::size_t c = 0; c < node.n_coupled; ++c) {
      const Coupled& coupled = coupled_[node.first_coupled + c];
      clear_tight_rows(coupled.node, coupled.offset);
      height += static_cast<std::size_t>(coupled.rows);
    }
    const Block& block = blocks[static_cast<std::size_t>(node.block)];
    for (std::size_t c = 0; c < cols; ++c) {
      if (block.tight[c] == 0) continue;
      for (std::size_t r = 0; r < height; ++r) panel[r * cols + c] = 0.0;
      panel[c * cols + c] = 1.0;
    }
  }
  eliminate(order_.joints(), nodes_.size());
}

void BlockLdlt::eliminate(std::size_t from, std::size_t to) {
  static_assert(kMaxRows == 5);
  for (std::size_t p = from; p < to; ++p) {
    const Node& node = nodes_[p];
    switch (node.rows) {
      case 1:
        eliminate<1>(node);
        break;
      case 2:
        eliminate<2>(node);
        break;
      case 3:
        eliminate<3>(node);
        break;
      case 4:
        eliminate<4>(node);
        break;
      default:
        eliminate<5>(node);
        break;
    }
  }
}

// With D the diagonal block and X a row of the panel below it:
//   D = L diag(d) L^T,  Y = X L^-T,  Z = Y diag(1/d);  what remains of A loses Z Y^T.
// L is kept below the diagonal, 1/d on it, Z in the panel.
template <int K>
void BlockLdlt::eliminate(const Node& node) {
  double* D = values_.data() + node.panel;
  for (int j = 0; j < K; ++j) {
    double d = D[j * K + j];
    double v[kMaxRows];
    for (int m = 0; m < j; ++m) {
      v[m] = D[j * K + m] / D[m * K + m];  // L_jm d_m
      d -= D[j * K + m] * v[m];
    }
    // A zero pivot: redundant rows without compliance. What follows is not a number, and is caught.
    D[j * K + j] = d != 0.0 ? 1.0 / d : std::numeric_limits<double>::quiet_NaN();
    for (int i = j + 1; i < K; ++i) {
      double s = D[i * K + j];
      for (int m = 0; m < j; ++m) s -= D[i * K + m] * v[m];
      D[i * K + j] = s * D[j * K + j];
    }
  }
  if (node.n_coupled == 0) return;

  const Coupled* coupled = coupled_.data() + node.first_coupled;
  const Coupled& last = coupled[node.n_coupled - 1];
  const std::size_t height = last.offset + static_cast<std::size_t>(last.rows);
  // Y is kept transposed, K x height, so that the innermost loop below runs along memory.
  double* Y = scratch_.data();
  for (std::size_t r = K; r < height; ++r) {
    double* x = D + r * K;
    double y[kMaxRows];
    for (int k = 0; k < K; ++k) {
      y[k] = x[k];
      for (int m = 0; m < k; ++m) y[k] -= y[m] * D[k * K + m];
      Y[static_cast<std::size_t>(k) * height + r] = y[k];
      x[k] = y[k] * D[k * K + k];
    }
  }
  const std::size_t* update = updates_.data() + node.first_update;
  for (std::size_t s = 0; s < node.n_coupled; ++s) {
    const double* Y_s = Y + coupled[s].offset;
    for (std::size_t t = s; t < node.n_coupled; ++t) {
      double* out = values_.data() + *update++;
      const double* Z_t = D + coupled[t].offset * K;
      const int rows = coupled[t].rows;
      switch (coupled[s].rows) {
        case 1:
          subtract_product<K, 1>(Z_t, rows, Y_s, height, out);
          break;
        case 2:
          subtract_product<K, 2>(Z_t, rows, Y_s, height, out);
          break;
        case 3:
          subtract_product<K, 3>(Z_t, rows, Y_s, height, out);
          break;
        case 4:
          subtract_product<K, 4>(Z_t, rows, Y_s, height, out);
          break;
        default:
          subtract_product<K, 5>(Z_t, rows, Y_s, height, out);
          break;
      }
    }
  }
}

template <int K>
void BlockLdlt::forward(const Node& node) {
  const double* D = values_.data() + node.panel;
  double* b = x_.data() + node.x;
  for (int k = 1; k < K; ++k) {
    for (int m = 0; m < k; ++m) b[k] -= D[k * K + m] * b[m];
  }
  for (std::size_t c = 0; c < node.n_coupled; ++c) {
    const Coupled& coupled = coupled_[node.first_coupled + c];
    const double* Z = D + coupled.offset * K;
    double* x = x_.data() + nodes_[static_cast<std::size_t>(coupled.node)].x;
    for (int r = 0; r < coupled.rows; ++r) {
      double sum = Z[r * K] * b[0];
      for (int k = 1; k < K; ++k) sum += Z[r * K + k] * b[k];
      x[r] -= sum;
    }
  }
}

template <int K>
void BlockLdlt::backward(const Node& node) {
  const double* D = values_.data() + node.panel;
  double* b = x_.data() + node.x;
  for (int k = 0; k < K; ++k) b[k] *= D[k * K + k];
  for (std::size_t c = 0; c < node.n_coupled; ++c) {
    const Coupled& coupled = coupled_[node.first_coupled + c];
    const double* Z = D + coupled.offset * K;
    const double* x = x_.data() + nodes_[static_cast<std::size_t>(coupled.node)].x;
    for (int r = 0; r < coupled.rows; ++r) {
      for (int k = 0; k < K; ++k) b[k] -= Z[r * K + k] * x[r];
    }
  }
  for (int k = K - 2; k >= 0; --k) {
    for (int m = k + 1; m < K; ++m) b[k] -= D[m * K + k] * b[m];
  }
}

void BlockLdlt::solve(std::span<const Block> blocks) {
  flops_ += cost_.solve;
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const Node& node = nodes_[p];
    if (p >= order_.joints()) {
      const Block& block = blocks[static_cast<std::size_t>(node.block)];
      for (int k = 0; k < node.rows; ++k) {
        if (block.tight[k] != 0) x_[node.x + static_cast<std::size_t>(k)] = 0.0;
      }
    }
    switch (node.rows) {
      case 1:
        forward<1>(node);
        break;
      case 2:
        forward<2>(node);
        break;
      case 3:
        forward<3>(node);
        break;
      case 4:
        forward<4>(node);
        break;
      default:
        forward<5>(node);
        break;
    }
  }
  for (std::size_t p = nodes_.size(); p-- > 0;) {
    const Node& node = nodes_[p];
    switch (node.rows) {
      case 1:
        backward<1>(node);
        break;
      case 2:
        backward<2>(node);
        break;
      case 3:
        backward<3>(node);
        break;
      case 4:
        backward<4>(node);
        break;
      default:
        backward<5>(node);
        break;
    }
  }
}

}  // namespace substep
