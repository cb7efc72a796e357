#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Disjoint sets of the numbers 0 to n - 1 (union-find with path halving). The root of a set is its
/// least number.
class DisjointSets {
 public:
  void reserve(std::size_t n) { parent_.reserve(n); }
  /// Each number in a set of its own.
  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[index(i)] != i) {
      int& parent = parent_[index(i)];
      parent = parent_[index(parent)];
      i = parent;
    }
    return i;
  }
  /// @return false if they were in one set
  bool unite(int a, int b) {
    const int p = root(a);
    const int q = root(b);
    parent_[index(std::max(p, q))] = std::min(p, q);
    return p != q;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace substep
