#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/solver/elimination_order.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// A = J Mt^-1 J^T + diag(softness) (Eq. 3) in blocks, and its factor L D L^T along the elimination
/// order. Only blocks that share a body, and those that fill in, are stored.
///
/// Rows of contacts can be *tight*: their impulse is given, so their row and column leave A. The
/// joints come first and are factored once per sub-step; what they leave for the contacts, the
/// Schur complement, is kept and factored anew for every active set.
class BlockLdlt {
 public:
  void reserve(std::size_t bodies, std::size_t blocks);
  /// Forms A and factors the joints.
  void begin(const System& system);
  /// Factors the contacts without their tight rows.
  void factor_contacts(std::span<const Block> blocks);

  /// Right-hand side and solution, by block and row. Tight rows are read as zero and left zero.
  [[nodiscard]] double* row(std::size_t block) {
    return x_.data() + nodes_[static_cast<std::size_t>(order_.position(static_cast<int>(block)))].x;
  }
  void solve(std::span<const Block> blocks);

  /// Floating-point operations since `begin`, that included.
  [[nodiscard]] std::int64_t flops() const { return flops_; }

 private:
  /// What each call costs with the present layout (flops.hpp).
  struct Cost {
    std::int64_t form = 0;
    std::int64_t joints = 0;
    std::int64_t contacts = 0;
    std::int64_t solve = 0;
  };

  /// A block in the order of elimination. Its panel holds the columns of the block from the
  /// diagonal down: rows x rows for itself, then the rows of every coupled block; row-major.
  struct Node {
    int block = 0;
    int rows = 0;
    std::size_t panel = 0;          // into values_
    std::size_t x = 0;              // into x_
    std::size_t first_coupled = 0;  // into coupled_
    std::size_t n_coupled = 0;
    std::size_t first_update = 0;  // into updates_
  };
  struct Coupled {
    int node = 0;
    int rows = 0;
    std::size_t offset = 0;  // first row in the panel
  };
  /// One product J_row W_col^T of two blocks that share a body.
  struct Product {
    int row_block, col_block;
    bool row_is_a, col_is_a;  // which side of each block is the shared body
    std::size_t at;           // into values_
  };
  /// Mt^-1 J^T of a block, for its two bodies.
  struct Weighted {
    double a[6][kMaxRows];
    double b[6][kMaxRows];
  };

  void lay_out(std::span<const Block> blocks);
  void count(std::span<const Block> blocks);
  void form(const System& system);
  template <int K>
  void eliminate(const Node& node);
  void eliminate(std::size_t from, std::size_t to);
  template <int K>
  void forward(const Node& node);
  template <int K>
  void backward(const Node& node);

  EliminationOrder order_;
  std::vector<Node> nodes_;
  std::vector<Coupled> coupled_;
  std::vector<std::size_t> updates_;  // per node and pair of its coupled blocks: where it goes
  std::vector<Product> products_;
  std::vector<std::size_t> diagonals_;  // into values_, per block
  std::vector<std::vector<int>> on_body_;
  std::vector<double> values_;
  std::vector<double> contacts_;  // the Schur complement of the contacts
  std::size_t contacts_at_ = 0;   // into values_
  std::vector<Weighted> weighted_;
  std::vector<double> scratch_;
  std::vector<double> x_;
  Cost cost_;
  std::int64_t flops_ = 0;
};

}  // namespace substep
