// Scrolling with a finger.

#include <imgui_internal.h>

#include <cmath>

#include "app/ui/widgets.hpp"

namespace substep::ui {

void scroll_by_drag() {
  const ImGuiIO& io = ImGui::GetIO();
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows |
                              ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) ||
      !ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4.0F)) {
    return;
  }
  // A pressed window background is active, as for moving the window.
  const bool on_ground = g.ActiveId == 0 || g.ActiveId == g.ActiveIdWindow->MoveId;
  if (!on_ground) {
    const ImVec2 way = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 4.0F);
    const bool for_panel = std::abs(way.y) > 10.0F && std::abs(way.y) > 2.0F * std::abs(way.x);
    if (io.MouseSource != ImGuiMouseSource_TouchScreen || !for_panel) return;
    ImGui::ClearActiveID();
  }
  ImGui::SetScrollY(ImGui::GetScrollY() - io.MouseDelta.y);
}

}  // namespace substep::ui
