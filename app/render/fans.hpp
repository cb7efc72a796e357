#pragma once
// How the convex areas of panels are cut into triangles.

#include <imgui.h>

namespace substep {

/// Dear ImGui fills a convex area by a fan of triangles. In a panel with round corners all of them
/// are thin and as long as the panel, and a processor goes over their rows one by one. Slices from
/// the top edge to the bottom cover the same pixels in fewer rows.
void slice_fans(ImDrawData& panels);

}  // namespace substep
