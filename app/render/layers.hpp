#pragma once
// What lies over the picture, from back to front, and which of it is drawn anew.

#include <imgui.h>

#include <cstddef>
#include <span>
#include <vector>

namespace substep {

/// Pixels of the window, from its top left corner.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const PixelRect&) const = default;
};

enum class Showing : unsigned char {
  kDraw,
  kDrawAndKeep,  // and its pixels are kept
  kKept          // as it was drawn last
};

/// A window of Dear ImGui with all that is in it, or marks straight over the picture.
struct Layer {
  ImGuiID id = 0;  // of the window, 0: marks
  PixelRect area;
  PixelRect covers;  // where nothing is seen through it: its area without the round corners
  Showing showing = Showing::kDraw;
  ImDrawData lists;
};

/// The draw lists of a frame, by the windows that they belong to. After ImGui::Render().
std::vector<Layer> layers_of(const ImDrawData& panels);

/// The parts of the window that no layer covers, without overlap.
std::vector<PixelRect> uncovered(const PixelRect& window, std::span<const PixelRect> covers);

/// Where a processor must draw, panels cost as much as the picture. Then one that did not change is
/// shown as it was drawn last, and those that change take turns: the picture moves with every
/// frame, a curve with every third or so.
class LayerKeeper {
 public:
  static constexpr int kTurn = 3;  // frames from one drawing of a panel to the next, at least

  /// Decides how each layer is shown. @param sparing false: all are drawn, and nothing is kept
  void plan(std::vector<Layer>& layers, bool sparing);

 private:
  struct Kept {
    ImGuiID id = 0;
    PixelRect area;
    std::size_t look = 0;  // hash of what was drawn
    int age = 0;           // frames since
  };
  std::vector<Kept> kept_;
};

}  // namespace substep
