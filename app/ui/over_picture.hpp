#pragma once
// Projection of world points to the display, for overlays on the picture.

#include <imgui.h>

#include <string>
#include <string_view>

#include "app/ui/look.hpp"
#include "app/ui/viewport.hpp"

namespace substep::ui {

/// World to display, with the matrices of the picture in a pane.
/// @return false if the point is behind the eye
bool project(const Viewport& viewport, const Vec3& x, ImVec2& out, std::size_t pane = 0);

/// Size of a logical pixel at a point of the world [m].
double pixel_size(const Viewport& viewport, const Vec3& x);

/// A text to the right of a ring, or to its left; if there is no room, above it. @param radius [px]
void ring_label(const Look& look, ImDrawList& draw, ImVec2 centre, float radius,
                const ViewRect& pane, const std::string& text);

/// Text with a soft halo of the background colour, readable on any body.
void draw_over(const Look& look, ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color,
               std::string_view text);

}  // namespace substep::ui
