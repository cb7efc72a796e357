#pragma once

#include <optional>

#include "app/render/camera.hpp"

namespace substep {

/// Turns a camera to what failed, and back when the run holds again. A camera that the user has
/// moved stays.
class FailureCamera {
 public:
  /// Call in every frame.
  /// @param failed around what failed; nothing while the run holds
  /// @param moves false: the camera stays (reduced motion)
  void follow(OrbitCamera& camera, const std::optional<Bounds>& failed, bool moves);

 private:
  std::optional<OrbitCamera> before_;  // while it shows a failure
  bool seen_ = false;                  // the present failure was followed or left alone
};

}  // namespace substep
