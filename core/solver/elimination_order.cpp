#include "core/solver/elimination_order.hpp"

#include <algorithm>
#include <limits>

namespace substep {

namespace {

constexpr std::size_t kTypicalDegree = 32;

template <class T>
void grow(std::vector<std::vector<T>>& lists, std::size_t size) {
  while (lists.size() < size) lists.emplace_back().reserve(kTypicalDegree);
}

}  // namespace

void EliminationOrder::reserve(std::size_t bodies, std::size_t blocks) {
  keys_.reserve(blocks);
  order_.reserve(blocks);
  position_.reserve(blocks);
  grow(graph_, blocks);
  grow(on_body_, bodies);
}

void EliminationOrder::connect(int block, int other) {
  auto& list = graph_[static_cast<std::size_t>(block)];
  const auto at = std::lower_bound(list.begin(), list.end(), other);
  if (at == list.end() || *at != other) list.insert(at, other);
}

bool EliminationOrder::update(std::span<const Block> blocks, std::size_t bodies) {
  const auto key = [](const Block& block) {
    return Key{block.a, block.b, block.rows, block.is_contact()};
  };
  if (keys_.size() == blocks.size() &&
      std::equal(blocks.begin(), blocks.end(), keys_.begin(),
                 [&](const Block& block, const Key& k) { return key(block) == k; })) {
    return false;
  }
  keys_.clear();
  for (const Block& block : blocks) keys_.push_back(key(block));

  const std::size_t n = blocks.size();
  grow(graph_, n);
  grow(on_body_, bodies);
  for (std::size_t i = 0; i < n; ++i) graph_[i].clear();
  for (auto& list : on_body_) list.clear();
  for (std::size_t i = 0; i < n; ++i) {
    for (const int body : {blocks[i].a, blocks[i].b}) {
      if (body < 0) continue;
      for (const int other : on_body_[static_cast<std::size_t>(body)]) {
        connect(static_cast<int>(i), other);
        connect(other, static_cast<int>(i));
      }
      on_body_[static_cast<std::size_t>(body)].push_back(static_cast<int>(i));
    }
  }

  order_.clear();
  position_.assign(n, -1);
  joints_ = 0;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = n;
    bool best_contact = true;
    std::size_t best_degree = std::numeric_limits<std::size_t>::max();
    for (std::size_t i = 0; i < n; ++i) {
      if (position_[i] >= 0) continue;
      const bool contact = keys_[i].contact;
      if (contact && !best_contact) continue;
      if ((best_contact && !contact) || graph_[i].size() < best_degree) {
        best = i;
        best_contact = contact;
        best_degree = graph_[i].size();
      }
    }
    position_[best] = static_cast<int>(k);
    order_.push_back(static_cast<int>(best));
    if (!best_contact) ++joints_;
    // What it couples becomes a clique, and forgets it.
    const auto& clique = graph_[best];
    for (const int i : clique) {
      auto& list = graph_[static_cast<std::size_t>(i)];
      list.erase(std::lower_bound(list.begin(), list.end(), static_cast<int>(best)));
      for (const int j : clique) {
        if (j != i) connect(i, j);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::sort(graph_[i].begin(), graph_[i].end(),
              [&](int p, int q) { return position(p) < position(q); });
  }
  return true;
}

}  // namespace substep
