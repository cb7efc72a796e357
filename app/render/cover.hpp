#pragma once
// Parts of the picture hidden by panels, and panels outside a part of the window. A software
// renderer spends most of a frame on filling pixels, so those are skipped.

#include <imgui.h>

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

/// The panels that hide the picture. Call after ImGui::Render().
struct Panels {
  std::vector<PixelRect> interiors;  // without the rounded corners, beside which it shows
  std::vector<PixelRect> bounds;     // with them and the smooth edge around

  bool operator==(const Panels&) const = default;
};
Panels panels_over_picture();

/// The uncovered parts of the window, without overlap.
std::vector<PixelRect> uncovered(const PixelRect& window, std::span<const PixelRect> covers);

/// The largest of them, extended up and down to the next cover; the whole window if each of them is
/// smaller than a quarter of it.
PixelRect largest_uncovered(const PixelRect& window, std::span<const PixelRect> covers);

/// Removes the draw lists without a vertex in a part of the window, and clips the others to it.
void keep_within(const PixelRect& part, ImDrawData& panels);

}  // namespace substep
