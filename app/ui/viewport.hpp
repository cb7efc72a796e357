#pragma once
// Where the runs are seen, and the pointer in them.

#include <cstddef>
#include <vector>

#include "app/render/picture.hpp"
#include "app/render/scene_view.hpp"
#include "core/math/types.hpp"

namespace substep {

/// What the pointer does in the picture while its button is down.
struct Hand {
  std::size_t pane = 0;        // that it went down in
  int body = -1;               // that it went down on, or -1
  Vec3 anchor = Vec3::Zero();  // where on it, body frame [m]
  Vec3 point = Vec3::Zero();   // the same in the world; it moves in the plane of view there [m]
  bool moved = false;          // farther than a click
  bool holding = false;        // the body follows
};

/// The part of the window that panels leave to the picture.
struct Viewport {
  SceneView view;
  ViewRect view_rect;
  /// This run in the first or only pane, those compared with it in the others.
  std::vector<ViewRect> panes{1};
  std::vector<Picture> pictures{1};  // of the panes
  Hand hand;
  bool pointer_on_picture = false;
};

}  // namespace substep
