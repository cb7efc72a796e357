#pragma once

#include <span>
#include <vector>

#include "core/collision/shape_pairs.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

// What a scene may have at once. Where bodies all overlap there would be billions: that is nothing
// to give to a solver, and must not use up memory.
inline constexpr std::size_t kMaxContacts = 200'000;  // contact points
inline constexpr std::size_t kMaxPairs = 1'000'000;   // bodies whose bounding boxes overlap

/// Finds every contact point of a scene with a gap of at most the scene's margin. The order of the
/// points depends on the order of bodies in the scene only.
class Detector {
 public:
  explicit Detector(const Scene& scene);

  /// @param R_WB rotation per body
  /// @return valid until the next call; not all of them where there are too_many()
  std::span<const ContactPoint> detect(const Scene& scene, const State& state,
                                       std::span<const Mat3> R_WB);
  /// Whether the last call stopped at a limit.
  [[nodiscard]] bool too_many() const {
    return pairs_.size() > kMaxPairs || points_.size() > kMaxContacts;
  }

 private:
  struct Interval {
    double lo = 0.0;  // of the bounding box along x, world [m]
    double hi = 0.0;
    int body = 0;
  };
  struct Pair {
    int i = 0;
    int j = 0;
  };
  [[nodiscard]] bool may_touch(const Scene& scene, int i, int j) const;

  std::vector<int> planes_;
  std::vector<int> solids_;                // spheres and boxes that collide
  std::vector<std::vector<int>> jointed_;  // per body: bodies of higher index joined to it, sorted
  std::vector<Vec3> reach_;                // half extents of the bounding boxes, world [m]
  std::vector<Interval> intervals_;
  std::vector<Pair> pairs_;
  ContactPoints points_;
};

}  // namespace substep
