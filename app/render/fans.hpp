#pragma once
// Triangulation of the convex areas of panels.

#include <imgui.h>

namespace substep {

/// Dear ImGui fills a convex area by a triangle fan. In a panel with rounded corners the triangles
/// are thin and as long as the panel, and a software rasteriser visits their rows one by one.
/// Horizontal slices cover the same pixels in fewer rows.
void slice_fans(ImDrawData& panels);

}  // namespace substep
