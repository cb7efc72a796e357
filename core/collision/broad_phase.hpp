#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

inline constexpr std::size_t kMaxPairs = 1'000'000;  // limit for a scene

/// Solids that may touch, by their bounding boxes: sweep and prune. Boxes are swept with a margin,
/// so that the pairs stay valid until a body leaves its margin: most sub-steps need no sweep.
class BroadPhase {
 public:
  struct Pair {
    int i = 0;  // bodies, i < j
    int j = 0;
  };

  explicit BroadPhase(const Scene& scene);

  /// Updates to the current poses. @param part whose bodies may have moved  @param R_WB rotation
  /// per body
  /// @param way travel bound per body until the next update [m]; empty: zero
  void update(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
              std::span<const double> way);
  /// Sorted by i, then j; a superset of the part's pairs for which overlap() is true.
  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }
  /// True if the boxes of a pair overlap, each enlarged by half the scene's margin and its travel
  /// bound.
  [[nodiscard]] bool overlap(const State& state, const Pair& pair) const;
  /// Half extents of a solid's box, enlarged by half the scene's margin and its travel bound [m].
  [[nodiscard]] const Vec3& reach(int body) const { return reach_[index(body)]; }
  /// True if there are more pairs than kMaxPairs; then the list is incomplete.
  [[nodiscard]] bool too_many() const { return pairs_.size() > kMaxPairs; }

  /// Solids and pairs looked at since the last call.
  std::int64_t take_visits() { return std::exchange(visits_, 0); }

  [[nodiscard]] std::span<const int> solids() const { return solids_; }
  /// True if collisions between two bodies are enabled.
  [[nodiscard]] bool may_touch(const Scene& scene, int i, int j) const;

 private:
  /// State of a body at the last sweep.
  struct Swept {
    Vec3 x = Vec3::Zero();      // centre, world [m]
    Vec3 reach = Vec3::Zero();  // half extents of the box [m]
    double room = 0.0;          // around it [m]
  };
  struct Interval {
    double lo = 0.0;  // of the box with its margin, along the sweep axis [m]
    double hi = 0.0;
    int body = 0;
  };
  [[nodiscard]] bool has_room(const Part& part, const State& state) const;
  void sweep(const Scene& scene, const State& state);

  std::vector<int> solids_;                // colliding spheres and boxes
  std::vector<std::vector<int>> jointed_;  // per body: bodies of higher index joined to it, sorted
  std::vector<Vec3> reach_;                // half extents of the bounding boxes, world [m]
  std::vector<Swept> swept_;
  std::vector<Interval> intervals_;
  std::vector<Pair> pairs_;
  bool valid_ = false;
  std::int64_t visits_ = 0;
};

}  // namespace substep
