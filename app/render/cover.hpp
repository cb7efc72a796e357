#pragma once
// What panels hide of the picture. A software renderer spends most of a frame on filling pixels, so
// those are left out.

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

/// The inside of every panel, without its round corners. After ImGui::Render().
std::vector<PixelRect> covered_by_panels();

/// The parts of the window that nothing covers, without overlap.
std::vector<PixelRect> uncovered(const PixelRect& window, std::span<const PixelRect> covers);

}  // namespace substep
