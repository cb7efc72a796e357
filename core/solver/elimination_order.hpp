#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/constraints/block.hpp"

namespace substep {

/// The order in which blocks are eliminated from J Mt^-1 J^T: of least degree first, joints before
/// contacts. Two blocks are neighbours if they share a moving body. A chain comes out as a chain, a
/// tree without fill; since contacts come last, a change of their active set leaves the joints'
/// factor as it is.
class EliminationOrder {
 public:
  void reserve(std::size_t bodies, std::size_t blocks);

  /// Finds the order anew if the graph has changed. @return true if it has
  bool update(std::span<const Block> blocks, std::size_t bodies);

  /// Blocks in the order of elimination.
  [[nodiscard]] std::span<const int> order() const { return order_; }
  /// How many of them, from the front, are joints.
  [[nodiscard]] std::size_t joints() const { return joints_; }
  /// Position of a block in the order.
  [[nodiscard]] int position(int block) const { return position_[static_cast<std::size_t>(block)]; }
  /// Blocks that are coupled to this one when it is eliminated, in the order of elimination.
  [[nodiscard]] std::span<const int> coupled(int block) const {
    return graph_[static_cast<std::size_t>(block)];
  }

 private:
  struct Key {
    int a, b, rows;
    bool contact;
    friend bool operator==(const Key&, const Key&) = default;
  };
  void connect(int block, int other);

  std::vector<Key> keys_;  // the graph that the order belongs to
  std::vector<std::vector<int>>
      graph_;  // per block, sorted; shrinks to `coupled` while eliminating
  std::vector<std::vector<int>> on_body_;
  std::vector<int> order_;
  std::vector<int> position_;
  std::size_t joints_ = 0;
};

}  // namespace substep
