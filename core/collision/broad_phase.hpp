#pragma once

#include <span>
#include <vector>

#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

inline constexpr std::size_t kMaxPairs = 1'000'000;  // that a scene may have at once

/// Solids that may touch, by their bounding boxes: sweep and prune. Boxes are swept with room to
/// move in, so that the pairs serve until some body has used up its room: in most sub-steps nothing
/// is swept at all.
class BroadPhase {
 public:
  struct Pair {
    int i = 0;  // bodies, i < j
    int j = 0;
  };

  explicit BroadPhase(const Scene& scene);

  /// Takes the poses. @param part whose bodies may have moved  @param R_WB rotation per body
  /// @param way that each body may go until it is looked at again [m]; empty: none
  void update(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
              std::span<const double> way);
  /// Sorted by i, then j; all those of the part of which overlap() is true, and others.
  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }
  /// Whether the boxes of a pair, each with half of the scene's margin and its way around it,
  /// overlap.
  [[nodiscard]] bool overlap(const State& state, const Pair& pair) const;
  /// Half extents of a solid's box, with half of the scene's margin and its way around it [m].
  [[nodiscard]] const Vec3& reach(int body) const { return reach_[index(body)]; }
  /// Whether more pairs were found than a scene may have; then not all are there.
  [[nodiscard]] bool too_many() const;

  [[nodiscard]] std::span<const int> solids() const { return solids_; }
  /// Whether collisions of two bodies are called for at all.
  [[nodiscard]] bool may_touch(const Scene& scene, int i, int j) const;

 private:
  /// A body where it was when boxes were last swept.
  struct Swept {
    Vec3 x = Vec3::Zero();      // centre, world [m]
    Vec3 reach = Vec3::Zero();  // half extents of the box [m]
    double room = 0.0;          // around it [m]
  };
  struct Interval {
    double lo = 0.0;  // of the box and its room, along the axis that is swept [m]
    double hi = 0.0;
    int body = 0;
  };
  [[nodiscard]] bool has_room(const Part& part, const State& state) const;
  void sweep(const Scene& scene, const State& state);

  std::vector<int> solids_;                // spheres and boxes that collide
  std::vector<std::vector<int>> jointed_;  // per body: bodies of higher index joined to it, sorted
  std::vector<Vec3> reach_;                // half extents of the bounding boxes, world [m]
  std::vector<Swept> swept_;
  std::vector<Interval> intervals_;
  std::vector<Pair> pairs_;
  bool valid_ = false;
};

}  // namespace substep
