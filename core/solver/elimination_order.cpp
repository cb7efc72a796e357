#include "core/solver/elimination_order.hpp"

#include <algorithm>
#include <iterator>

namespace substep {

namespace {

constexpr std::size_t kTypicalDegree = 32;
constexpr int kNone = -1;
constexpr int kUnordered = -2;  // a position to come

std::size_t index(int i) { return static_cast<std::size_t>(i); }

void insert(std::vector<int>& sorted, int value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at == sorted.end() || *at != value) sorted.insert(at, value);
}

}  // namespace

void EliminationOrder::reserve(std::size_t bodies, std::size_t blocks) {
  edges_.reserve(blocks);
  found_.reserve(blocks);
  merged_.reserve(bodies);
  first_.reserve(bodies + 2);
  next_.reserve(bodies);
  previous_.reserve(bodies);
  degree_.reserve(bodies);
  order_.reserve(bodies);
  position_.reserve(bodies);
  while (graph_.size() < bodies) graph_.emplace_back().reserve(kTypicalDegree);
}

bool EliminationOrder::update(std::span<const Block> blocks, std::size_t bodies) {
  const int world = static_cast<int>(bodies);
  read_edges(blocks, world);
  if (world == world_ && found_ == edges_) return false;
  std::swap(found_, edges_);
  world_ = world;
  build_graph(world);
  eliminate(world);
  return true;
}

void EliminationOrder::read_edges(std::span<const Block> blocks, int world) {
  found_.clear();
  for (const Block& block : blocks) {
    Edge edge{std::min(block.a, block.b), std::max(block.a, block.b)};
    if (edge.low < 0) edge = {edge.high, block.is_contact() ? edge.high : world};
    // The points of a contact follow each other.
    if (found_.empty() || !(found_.back() == edge)) found_.push_back(edge);
  }
}

void EliminationOrder::build_graph(int world) {
  const std::size_t bodies = index(world);
  while (graph_.size() < bodies) graph_.emplace_back().reserve(kTypicalDegree);
  for (std::size_t i = 0; i < bodies; ++i) graph_[i].clear();
  position_.assign(bodies, kNone);
  for (const Edge& edge : edges_) {
    position_[index(edge.low)] = kUnordered;
    if (edge.low == edge.high) continue;
    insert(graph_[index(edge.low)], edge.high);
    if (edge.high == world) continue;
    insert(graph_[index(edge.high)], edge.low);
    position_[index(edge.high)] = kUnordered;
  }
}

void EliminationOrder::enqueue(int body, std::size_t degree) {
  degree_[index(body)] = degree;
  int& first = first_[degree];
  next_[index(body)] = first;
  previous_[index(body)] = kNone;
  if (first != kNone) previous_[index(first)] = body;
  first = body;
}

void EliminationOrder::dequeue(int body) {
  const int next = next_[index(body)];
  const int previous = previous_[index(body)];
  if (next != kNone) previous_[index(next)] = previous;
  (previous != kNone ? next_[index(previous)] : first_[degree_[index(body)]]) = next;
}

void EliminationOrder::eliminate(int world) {
  const std::size_t bodies = index(world);
  first_.assign(bodies + 2, kNone);
  next_.resize(bodies);
  previous_.resize(bodies);
  degree_.resize(bodies);
  order_.clear();
  std::size_t left = 0;
  for (int body = world; body-- > 0;) {  // of equal degree, the first is eliminated first
    if (position(body) == kNone) continue;
    enqueue(body, graph_[index(body)].size());
    ++left;
  }
  for (std::size_t degree = 0; left > 0; --left) {
    while (first_[degree] == kNone) ++degree;
    const int body = first_[degree];
    dequeue(body);
    position_[index(body)] = static_cast<int>(order_.size());
    order_.push_back(body);
    const std::vector<int>& clique = graph_[index(body)];
    for (const int other : clique) {
      if (other == world) continue;
      merged_.clear();
      const std::vector<int>& list = graph_[index(other)];
      std::set_union(list.begin(), list.end(), clique.begin(), clique.end(),
                     std::back_inserter(merged_));
      dequeue(other);
      graph_[index(other)].clear();
      for (const int i : merged_) {
        if (i != body && i != other) graph_[index(other)].push_back(i);
      }
      enqueue(other, graph_[index(other)].size());
      degree = std::min(degree, graph_[index(other)].size());
    }
  }
  for (const int body : order_) {
    auto& list = graph_[index(body)];
    if (!list.empty() && list.back() == world) list.pop_back();
    std::sort(list.begin(), list.end(), [&](int p, int q) { return position(p) < position(q); });
  }
}

}  // namespace substep
