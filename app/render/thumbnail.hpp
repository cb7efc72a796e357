#pragma once
// A small picture of a scene at its start, as flat polygons: for a menu, without the renderer.

#include <array>
#include <cstddef>
#include <vector>

#include "app/render/picture.hpp"
#include "app/render/scene_view.hpp"

namespace substep {

/// Convex polygons from back to front, over the palette's background.
struct Thumbnail {
  static constexpr float kAspect = 1.5F;  // width over height

  struct Polygon {
    std::size_t first = 0;  // of its points
    std::size_t count = 0;
    Color color;
    bool outlined = false;  // a body's silhouette: at least a pixel wide
  };
  std::vector<std::array<float, 2>> points;  // from the top left corner; 1 is the height
  std::vector<Polygon> polygons;
};

/// The scene in its initial pose, seen along its own camera and fitted to the frame. Of very many
/// bodies the largest are shown.
Thumbnail thumbnail_of(const Scene& scene, const ViewPalette& palette);

}  // namespace substep
