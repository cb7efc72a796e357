#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

class BroadPhase;

/// A body that passed through another between the ends of two frames.
struct Passage {
  int through = -1;    // the body that was passed through
  int body = -1;       // the body that passed
  double depth = 0.0;  // of the path of its centre under the surface [m]
};

/// Finds bodies that pass through each other between the ends of two frames, where no overlap shows
/// it. A body has passed if its centre was outside the other at both ends, and the straight path
/// between them, in the other's frame, runs under its surface by at least a quarter of its smallest
/// width and by more than rotation and joints can bend the true path aside. Paths that only cut an
/// edge are not found. Pairs that do not collide may pass.
class PassageWatch {
 public:
  PassageWatch(const Scene& scene, const State& start);

  /// @param now state at the end of the next frame
  /// @return the first pair found
  std::optional<Passage> add(const Scene& scene, const State& now);

 private:
  struct Pose {
    Vec3 x;
    Quat q;
    Vec6 u;
  };
  [[nodiscard]] std::optional<Passage> first(const Scene& scene, const State& now);
  [[nodiscard]] std::optional<double> depth_of_path(const Scene& scene, const State& now, int body,
                                                    int through) const;

  std::shared_ptr<const BroadPhase> collisions_;  // which pairs collide
  std::vector<Pose> before_;                      // at the end of the last frame
  std::vector<bool> joined_;                      // per body: it has a joint
  std::vector<bool> fast_;                        // per body: it may have passed through one
  std::vector<double> reach_;                     // per body: of its points in the frame [m]
  std::vector<int> sorted_;                       // bodies along the longest axis
  double narrowest_ = 0.0;                        // half width of a colliding body [m]
};

}  // namespace substep
