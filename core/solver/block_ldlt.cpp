#include "core/solver/block_ldlt.hpp"

#include <algorithm>

namespace substep {

namespace {

/// W = Mt^-1 J^T, transposed: one row of W per row of J.
void weigh(const double (&J)[kMaxRows][6], int rows, const InverseMass& mass, double (&W)[kMaxRows][6]) {
  for (int r = 0; r < rows; ++r) {
    for (int i = 0; i < 3; ++i) {
      W[r][i] = mass.linear * J[r][i];
      W[r][3 + i] = mass.angular(i, 0) * J[r][3] + mass.angular(i, 1) * J[r][4] + mass.angular(i, 2) * J[r][5];
    }
  }
}

/// out += J W^T, out row-major with `cols` columns.
void add_product(const double (&J)[kMaxRows][6], int rows, const double (&W)[kMaxRows][6], int cols,
                 double* out) {
  for (int r = 0; r < rows; ++r) {
    const double* j = J[r];
    for (int c = 0; c < cols; ++c) {
      const double* w = W[c];
      out[r * cols + c] +=
          (j[0] * w[0] + j[1] * w[1] + j[2] * w[2]) + (j[3] * w[3] + j[4] * w[4] + j[5] * w[5]);
    }
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
      if (on_body_.size() <= static_cast<std::size_t>(body)) on_body_.resize(static_cast<std::size_t>(body) + 1);
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
      weigh(block.J_a, block.rows, system.inverse_mass[static_cast<std::size_t>(block.a)], W.a);
      add_product(block.J_a, block.rows, W.a, block.rows, D);
    }
    if (block.b >= 0) {
      weigh(block.J_b, block.rows, system.inverse_mass[static_cast<std::size_t>(block.b)], W.b);
      add_product(block.J_b, block.rows, W.b, block.rows, D);
    }
  }
  for (const Product& product : products_) {
    const Block& row = blocks[static_cast<std::size_t>(product.row_block)];
    const Block& col = blocks[static_cast<std::size_t>(product.col_block)];
    const Weighted& W = weighted_[static_cast<std::size_t>(product.col_block)];
    add_product(product.row_is_a ? row.J_a : row.J_b, row.rows, product.col_is_a ? W.a : W.b, col.rows,
                values_.data() + product.at);
  }
}

void BlockLdlt::begin(const System& system) {
  if (order_.update(system.blocks, system.u.size())) lay_out(system.blocks);
  form(system);
  eliminate(0, order_.joints());
  std::copy(values_.begin() + static_cast<std::ptrdiff_t>(contacts_at_), values_.end(), contacts_.begin());
}

void BlockLdlt::factor_contacts(std::span<const Block> blocks) {
  std::copy(contacts_.begin(), contacts_.end(), values_.begin() + static_cast<std::ptrdiff_t>(contacts_at_));
  for (std::size_t p = order_.joints(); p < nodes_.size(); ++p) {
    const Node& node = nodes_[p];
    double* panel = values_.data() + node.panel;
    const auto cols = static_cast<std::size_t>(node.rows);
    const auto clear_tight_rows = [&](int of_node, std::size_t offset) {
      const Block& block = blocks[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(of_node)].block)];
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
      case 1: eliminate<1>(node); break;
      case 2: eliminate<2>(node); break;
      case 3: eliminate<3>(node); break;
      case 4: eliminate<4>(node); break;
      default: eliminate<5>(node); break;
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
    D[j * K + j] = 1.0 / d;
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
  double* Y = scratch_.data();
  for (std::size_t r = K; r < height; ++r) {
    double* x = D + r * K;
    double* y = Y + r * K;
    for (int k = 0; k < K; ++k) {
      double s = x[k];
      for (int m = 0; m < k; ++m) s -= y[m] * D[k * K + m];
      y[k] = s;
    }
    for (int k = 0; k < K; ++k) x[k] = y[k] * D[k * K + k];
  }
  const std::size_t* update = updates_.data() + node.first_update;
  for (std::size_t s = 0; s < node.n_coupled; ++s) {
    const double* Y_s = Y + coupled[s].offset * K;
    for (std::size_t t = s; t < node.n_coupled; ++t) {
      double* out = values_.data() + *update++;
      const double* Z_t = D + coupled[t].offset * K;
      for (int r = 0; r < coupled[t].rows; ++r) {
        for (int c = 0; c < coupled[s].rows; ++c) {
          double sum = Z_t[r * K] * Y_s[c * K];
          for (int k = 1; k < K; ++k) sum += Z_t[r * K + k] * Y_s[c * K + k];
          out[r * coupled[s].rows + c] -= sum;
        }
      }
    }
  }
}

void BlockLdlt::solve(std::span<const Block> blocks) {
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const Node& node = nodes_[p];
    const double* D = values_.data() + node.panel;
    double* b = x_.data() + node.x;
    const int K = node.rows;
    if (p >= order_.joints()) {
      const Block& block = blocks[static_cast<std::size_t>(node.block)];
      for (int k = 0; k < K; ++k) {
        if (block.tight[k] != 0) b[k] = 0.0;
      }
    }
    for (int k = 1; k < K; ++k) {
      for (int m = 0; m < k; ++m) b[k] -= D[k * K + m] * b[m];
    }
    for (std::size_t c = 0; c < node.n_coupled; ++c) {
      const Coupled& coupled = coupled_[node.first_coupled + c];
      const double* Z = D + coupled.offset * static_cast<std::size_t>(K);
      double* x = x_.data() + nodes_[static_cast<std::size_t>(coupled.node)].x;
      for (int r = 0; r < coupled.rows; ++r) {
        double sum = 0.0;
        for (int k = 0; k < K; ++k) sum += Z[r * K + k] * b[k];
        x[r] -= sum;
      }
    }
  }
  for (std::size_t p = nodes_.size(); p-- > 0;) {
    const Node& node = nodes_[p];
    const double* D = values_.data() + node.panel;
    double* b = x_.data() + node.x;
    const int K = node.rows;
    for (int k = 0; k < K; ++k) b[k] *= D[k * K + k];
    for (std::size_t c = 0; c < node.n_coupled; ++c) {
      const Coupled& coupled = coupled_[node.first_coupled + c];
      const double* Z = D + coupled.offset * static_cast<std::size_t>(K);
      const double* x = x_.data() + nodes_[static_cast<std::size_t>(coupled.node)].x;
      for (int r = 0; r < coupled.rows; ++r) {
        for (int k = 0; k < K; ++k) b[k] -= Z[r * K + k] * x[r];
      }
    }
    for (int k = K - 2; k >= 0; --k) {
      for (int m = k + 1; m < K; ++m) b[k] -= D[m * K + k] * b[m];
    }
  }
}

}  // namespace substep
