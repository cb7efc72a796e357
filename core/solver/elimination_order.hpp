#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/constraints/block.hpp"

namespace substep {

/// Minimum-degree elimination order of the bodies. Two bodies are neighbours if a constraint
/// connects them; eliminating a body connects all its neighbours. Joint trees are ordered from
/// leaves to root without fill: the world counts as a permanent neighbour, so that a chain starts
/// at its free end. Bodies with more joint rows than the closed form of one joint handles come
/// last; for them the world is not counted, and one joined to it comes after a free one. Ties of at
/// most two neighbours go to bodies that have received no contribution.
///
/// The order depends on the connected pairs and their joints, not on the number of contact points,
/// and is recomputed only when a pair or a joint is added or removed.
class EliminationOrder {
 public:
  void reserve(std::size_t bodies, std::size_t blocks);

  /// @param most_memory limit for the factor [bytes]
  /// @return true if the graph, and hence the order, has changed. There is no order if
  /// needed_memory() exceeds the limit.
  bool update(std::span<const Block> blocks, std::size_t bodies,
              double most_memory = std::numeric_limits<double>::infinity());
  /// Lower bound on the memory of a factor in this order [bytes]; counting stops beyond 64 times
  /// the limit.
  [[nodiscard]] double needed_memory() const { return needed_memory_; }

  /// Bodies with a constraint, in the order of elimination.
  [[nodiscard]] std::span<const int> order() const { return order_; }
  /// Position of a body in the order, -1 without constraints.
  [[nodiscard]] int position(int body) const { return position_[static_cast<std::size_t>(body)]; }
  /// Bodies coupled to a body at its elimination, in the order of elimination.
  [[nodiscard]] std::span<const int> coupled(int body) const {
    return graph_[static_cast<std::size_t>(body)];
  }

 private:
  struct Edge {
    int low, high;  // the world has index `bodies`; low = high: a single body
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

  std::vector<Edge> edges_;  // the graph of the current order, indexed as in the blocks
  std::vector<Edge> found_;
  int world_ = -1;
  double needed_memory_ = 0.0;
  std::vector<std::vector<int>> graph_;  // per body, sorted; ends as `coupled`
  std::vector<int> merged_;
  std::vector<int> joint_rows_;  // per body: joint rows to the world and bodies not yet eliminated
  std::vector<std::vector<int>> joined_;  // per body: edges with joints
  // Bodies by priority: doubly linked lists, for constant-time updates.
  std::vector<int> first_;  // per priority
  std::vector<int> next_;   // per body
  std::vector<int> previous_;
  std::vector<std::size_t> priority_;
  std::vector<char> reached_;  // per body: a neighbour of it has been eliminated
  std::vector<int> order_;
  std::vector<int> position_;
};

}  // namespace substep
