#include "app/render/failure_camera.hpp"

namespace substep {

void FailureCamera::follow(OrbitCamera& camera, const std::optional<Bounds>& failed, bool moves) {
  // A new scene has reset the camera, or the user has moved it.
  if (before_ && (camera.placed() != before_->placed() || camera.by_hand())) before_.reset();
  if (failed) {
    if (!seen_ && moves && !camera.by_hand()) {
      before_ = camera;
      camera.turn_to(*failed);
    }
    seen_ = true;
    return;
  }
  seen_ = false;
  if (before_) camera.return_to(*before_);
  before_.reset();
}

}  // namespace substep
