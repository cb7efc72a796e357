#pragma once
// For what is drawn over the picture: where things of the world are on the display.

#include <imgui.h>

#include "app/ui/look.hpp"
#include "app/ui/viewport.hpp"

namespace substep::ui {

/// World to the display, by the matrices of the picture that is shown in a pane.
/// @return false behind the eye
bool project(const Viewport& viewport, const Vec3& x, ImVec2& out, std::size_t pane = 0);

/// How long a logical pixel is at a point of the world [m].
double pixel_size(const Viewport& viewport, const Vec3& x);

/// Text with a soft halo of the background around it: readable on any body.
void draw_over(const Look& look, ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color,
               const char* text);

}  // namespace substep::ui
