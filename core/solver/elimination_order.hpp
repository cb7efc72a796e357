#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/constraints/block.hpp"

namespace substep {

/// The order in which bodies are eliminated: of least degree first. Two bodies are neighbours if a
/// constraint joins them, and all neighbours of a body that is eliminated become neighbours of each
/// other. A tree of joints comes out from the leaves to the root without fill: the world counts as
/// a neighbour that stays, so that a chain starts at its free end. Bodies with more rows of joints
/// than the closed form of one joint takes come last; of them the world is no neighbour, and one
/// joined to it yields to a free one. Among equals of at most two neighbours those go first that
/// no neighbour has left anything on.
///
/// The order depends on the pairs of bodies and the joints between them, not on how many points
/// they touch in, and is found again only when a pair or a joint comes or goes.
class EliminationOrder {
 public:
  void reserve(std::size_t bodies, std::size_t blocks);

  /// @param most_memory that a factor may take [bytes]
  /// @return true if the graph, and with it the order, has changed. Where needed_memory() is more
  /// than the limit there is no order.
  bool update(std::span<const Block> blocks, std::size_t bodies,
              double most_memory = std::numeric_limits<double>::infinity());
  /// No more than what a factor in this order takes; past 64 times the limit it is not counted on
  /// [bytes].
  [[nodiscard]] double needed_memory() const { return needed_memory_; }

  /// Bodies with a constraint, in the order of elimination.
  [[nodiscard]] std::span<const int> order() const { return order_; }
  /// Place of a body in the order, -1 without constraints.
  [[nodiscard]] int position(int body) const { return position_[static_cast<std::size_t>(body)]; }
  /// Bodies that a body is coupled to when it is eliminated, in the order of elimination.
  [[nodiscard]] std::span<const int> coupled(int body) const {
    return graph_[static_cast<std::size_t>(body)];
  }

 private:
  struct Edge {
    int low, high;  // the world's number is that of the bodies; low = high: a body by itself
    int rows;       // of joints
    friend bool operator==(const Edge&, const Edge&) = default;
  };
  void make_room(std::size_t bodies);
  void read_edges(std::span<const Block> blocks, int world);
  void build_graph(int world);
  void eliminate(int world, double most_memory);
  [[nodiscard]] std::size_t priority(int body) const;
  void enqueue(int body);
  void dequeue(int body);

  std::vector<Edge> edges_;  // the graph that the order belongs to, as the blocks name it
  std::vector<Edge> found_;
  int world_ = -1;
  double needed_memory_ = 0.0;
  std::vector<std::vector<int>> graph_;  // per body, sorted; ends as `coupled`
  std::vector<int> merged_;
  std::vector<int> joint_rows_;           // per body: to the world and bodies not yet eliminated
  std::vector<std::vector<int>> joined_;  // per body: edges with joints
  // Bodies by priority: doubly linked lists, so that a body changes its list in constant time.
  std::vector<int> first_;  // per priority
  std::vector<int> next_;   // per body
  std::vector<int> previous_;
  std::vector<std::size_t> priority_;
  std::vector<char> reached_;  // per body: a neighbour of it has been eliminated
  std::vector<int> order_;
  std::vector<int> position_;
};

}  // namespace substep
