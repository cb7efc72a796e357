#pragma once
// Small pictures of scenes, made when they are first seen and kept.

#include <imgui.h>

#include <memory>
#include <vector>

#include "app/render/thumbnail.hpp"

namespace substep::ui {

class Thumbnails {
 public:
  /// Draws the picture of a scene in a frame with rounded corners.
  /// @param min, max of the frame on the display
  void draw(ImDrawList& draw, const std::shared_ptr<const Scene>& scene, const ViewPalette& palette,
            ImVec2 min, ImVec2 max);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene;
    Color floor;  // of the palette
    Thumbnail picture;
  };
  const Thumbnail* of(const std::shared_ptr<const Scene>& scene, const ViewPalette& palette);

  std::vector<Entry> entries_;
  int frame_ = -1;  // the last in which pictures were made
  int made_ = 0;    // in that frame
};

}  // namespace substep::ui
