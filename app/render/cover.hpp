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

/// The interior of every panel, without its rounded corners. Call after ImGui::Render().
std::vector<PixelRect> covered_by_panels();

/// The uncovered parts of the window, without overlap.
std::vector<PixelRect> uncovered(const PixelRect& window, std::span<const PixelRect> covers);

/// The largest of them; the whole window if it is less than a quarter of it.
PixelRect largest_uncovered(const PixelRect& window, std::span<const PixelRect> covers);

/// Removes the draw lists without a vertex in a part of the window, and clips the others to it.
void keep_within(const PixelRect& part, ImDrawData& panels);

}  // namespace substep
