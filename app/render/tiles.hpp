#pragma once
// Which parts of the panels must be drawn anew on a window that keeps its pixels, and just those.

#include <imgui.h>

#include <cstdint>
#include <span>
#include <vector>

#include "app/render/layers.hpp"

namespace substep {

/// What a window that keeps its pixels shows of the panels, in tiles.
class TileRecord {
 public:
  static constexpr int kTile = 32;  // edge [pixel]

  /// Where the window must be cleared and drawn anew to show these layers, without overlap. It
  /// shows them from then on; of a layer that is kept, what it showed.
  std::vector<PixelRect> changes(int width, int height, std::span<const Layer> layers);
  /// The window shows something else.
  void forget() { width_ = height_ = 0; }

 private:
  struct Shown {
    ImGuiID id = 0;
    std::vector<std::uint64_t> tiles;  // hash of the triangles that touch each, in their order
  };
  [[nodiscard]] std::vector<std::uint64_t> tiles_of(const ImDrawData& lists) const;

  std::vector<Shown> shown_;
  int width_ = 0;  // of the window [pixel]
  int height_ = 0;
  int columns_ = 0;  // of tiles
  int rows_ = 0;
};

/// Of the draw lists what lies in these parts of the window, cut off at their edges, to be drawn
/// at once. The lists themselves are changed.
ImDrawData limited_to(std::span<const PixelRect> parts, std::span<const Layer> layers);

}  // namespace substep
