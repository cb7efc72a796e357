#include "core/solver/elimination_order.hpp"

#include <algorithm>
#include <iterator>

#include "core/solver/articulated_joint.hpp"

namespace substep {

namespace {

constexpr std::size_t kTypicalDegree = 32;
constexpr std::size_t kTypicalJoints = 4;
constexpr int kNone = -1;
constexpr int kUnordered = -2;  // not yet ordered

constexpr std::size_t kMostBare = 8;  // limit of neighbours for a body without stored contribution
constexpr double kCountedOn = 64.0;   // times the limit, to report by how much it is exceeded

/// Of the symmetric matrix that a body leaves on its neighbours [bytes].
double update_memory(std::size_t neighbours) {
  const double width = 6.0 * static_cast<double>(neighbours);
  return width * width * sizeof(double);
}

void insert(std::vector<int>& sorted, int value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at == sorted.end() || *at != value) sorted.insert(at, value);
}

}  // namespace

void EliminationOrder::reserve(std::size_t bodies, std::size_t blocks) {
  edges_.reserve(blocks);
  found_.reserve(blocks);
  merged_.reserve(bodies);
  joint_rows_.reserve(bodies);
  first_.reserve(4 * bodies + 8);
  next_.reserve(bodies);
  previous_.reserve(bodies);
  priority_.reserve(bodies);
  reached_.reserve(bodies);
  order_.reserve(bodies);
  position_.reserve(bodies);
  make_room(bodies);
}

void EliminationOrder::make_room(std::size_t bodies) {
  while (graph_.size() < bodies) graph_.emplace_back().reserve(kTypicalDegree);
  while (joined_.size() < bodies) joined_.emplace_back().reserve(kTypicalJoints);
}

bool EliminationOrder::update(std::span<const Block> blocks, std::size_t bodies,
                              double most_memory) {
  const int world = static_cast<int>(bodies);
  read_edges(blocks, world);
  if (world == world_ && found_ == edges_) return false;
  std::swap(found_, edges_);
  world_ = world;
  build_graph(world);
  eliminate(world, most_memory);
  if (needed_memory_ > most_memory) world_ = -1;  // forces recomputation of the order
  return true;
}

void EliminationOrder::read_edges(std::span<const Block> blocks, int world) {
  found_.clear();
  for (const Block& block : blocks) {
    Edge edge{std::min(block.a, block.b), std::max(block.a, block.b),
              block.is_bounded() ? 0 : block.rows};
    if (edge.low < 0) {
      edge.low = edge.high;
      if (!block.is_bounded()) edge.high = world;
    }
    // Points of the same contact are adjacent.
    if (edge.rows == 0 && !found_.empty() && found_.back() == edge) continue;
    found_.push_back(edge);
  }
}

void EliminationOrder::build_graph(int world) {
  const std::size_t bodies = index(world);
  make_room(bodies);
  for (std::size_t i = 0; i < bodies; ++i) {
    graph_[i].clear();
    joined_[i].clear();
  }
  position_.assign(bodies, kNone);
  joint_rows_.assign(bodies, 0);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Edge& edge = edges_[e];
    position_[index(edge.low)] = kUnordered;
    if (edge.rows > 0) {
      for (const int body : {edge.low, edge.high}) {
        if (body == world) continue;
        joined_[index(body)].push_back(static_cast<int>(e));
        joint_rows_[index(body)] += edge.rows;
      }
    }
    if (edge.low == edge.high) continue;
    insert(graph_[index(edge.low)], edge.high);
    if (edge.high == world) continue;
    insert(graph_[index(edge.high)], edge.low);
    position_[index(edge.high)] = kUnordered;
  }
}

std::size_t EliminationOrder::priority(int body) const {
  const std::vector<int>& neighbours = graph_[index(body)];
  std::size_t degree = neighbours.size();
  bool anchored = false;
  if (joint_rows_[index(body)] > ArticulatedJoint::kMostRows) {
    // More rows than the closed form of one joint handles: the world is not counted, so that a
    // bridge is eliminated from its ends. A free end comes before an anchored one, which has twice
    // the rows.
    anchored = !neighbours.empty() && neighbours.back() == world_;
    degree += index(world_) + (anchored ? 0 : 1);
  }
  // Ties: a body without contributions goes first, because only its own rows are factored. In a
  // stack the balls then precede the plates between them. With more neighbours, as in a grid, this
  // would only scatter the order.
  const bool bare = neighbours.size() <= 2 && !anchored && !reached_[index(body)];
  return 2 * degree + (bare ? 0 : 1);
}

void EliminationOrder::enqueue(int body) {
  priority_[index(body)] = priority(body);
  int& first = first_[priority_[index(body)]];
  next_[index(body)] = first;
  previous_[index(body)] = kNone;
  if (first != kNone) previous_[index(first)] = body;
  first = body;
}

void EliminationOrder::dequeue(int body) {
  const int next = next_[index(body)];
  const int previous = previous_[index(body)];
  if (next != kNone) previous_[index(next)] = previous;
  (previous != kNone ? next_[index(previous)] : first_[priority_[index(body)]]) = next;
}

void EliminationOrder::eliminate(int world, double most_memory) {
  const std::size_t bodies = index(world);
  first_.assign(4 * bodies + 8, kNone);
  reached_.assign(bodies, false);
  next_.resize(bodies);
  previous_.resize(bodies);
  priority_.resize(bodies);
  order_.clear();
  needed_memory_ = 0.0;
  std::size_t left = 0;
  for (int body = world; body-- > 0;) {  // ties: lowest index first
    if (position(body) == kNone) continue;
    enqueue(body);
    ++left;
  }
  for (std::size_t least = 0; left > 0; --left) {
    while (first_[least] == kNone) ++least;
    const int body = first_[least];
    dequeue(body);
    position_[index(body)] = static_cast<int>(order_.size());
    order_.push_back(body);
    for (const int e : joined_[index(body)]) {
      const Edge& edge = edges_[index(e)];
      const int other = edge.low == body ? edge.high : edge.low;
      if (other != world) joint_rows_[index(other)] -= edge.rows;
    }
    const std::vector<int>& clique = graph_[index(body)];
    if (clique.size() > kMostBare) needed_memory_ += update_memory(clique.size());
    if (needed_memory_ > kCountedOn * most_memory) return;
    for (const int other : clique) {
      if (other == world) continue;
      merged_.clear();
      std::vector<int>& list = graph_[index(other)];
      std::set_union(list.begin(), list.end(), clique.begin(), clique.end(),
                     std::back_inserter(merged_));
      dequeue(other);
      list.clear();
      for (const int i : merged_) {
        if (i != body && i != other) list.push_back(i);
      }
      reached_[index(other)] = true;
      enqueue(other);
      least = std::min(least, priority_[index(other)]);
    }
  }
  for (const int body : order_) {
    auto& list = graph_[index(body)];
    if (!list.empty() && list.back() == world) list.pop_back();
    std::sort(list.begin(), list.end(), [&](int p, int q) { return position(p) < position(q); });
  }
}

}  // namespace substep
