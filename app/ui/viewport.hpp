#pragma once
// Position of the runs in the window, and pointer state in them.

#include <cstddef>
#include <vector>

#include "app/render/failure_camera.hpp"
#include "app/render/picture.hpp"
#include "app/render/scene_view.hpp"
#include "core/math/types.hpp"

namespace substep {

/// State of the pointer in the picture while its button is down.
struct Hand {
  std::size_t pane = 0;        // under the pointer at the press
  int body = -1;               // under the pointer at the press, or -1
  Vec3 anchor = Vec3::Zero();  // point on the body, body frame [m]
  Vec3 point = Vec3::Zero();   // the same in the world; moves parallel to the view plane [m]
  bool moved = false;          // farther than for a click
  bool holding = false;        // the body is being pulled
};

/// The part of the window not covered by panels.
struct Viewport {
  SceneView view;
  FailureCamera failure_camera;
  ViewRect view_rect;
  /// This run in the first pane, those compared with it in the others.
  std::vector<ViewRect> panes{1};
  std::vector<Picture> pictures{1};  // of the panes
  Hand hand;
  bool pointer_on_picture = false;
};

}  // namespace substep
