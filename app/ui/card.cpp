#include "app/ui/card.hpp"

#include <algorithm>

namespace substep::ui {

bool begin_card(const Look& look, const Viewport& viewport, const char* id, float width,
                float centre_y, float pivot_y) {
  const ViewRect& v = viewport.view_rect;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  width = std::min(width, display.x - 24.0F);
  const float x =
      std::clamp(v.x + 0.5F * v.width, 12.0F + 0.5F * width, display.x - 12.0F - 0.5F * width);
  ImGui::SetNextWindowPos({x, centre_y}, ImGuiCond_Always, {0.5F, pivot_y});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, display.y - 96.0F});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, look.theme->raised);
  const bool open =
      ImGui::Begin(id, nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleColor();
  return open;
}

float card_middle(const Viewport& viewport) {
  constexpr float kRoom = 560.0F;
  const ViewRect& v = viewport.view_rect;
  return v.height > kRoom ? v.y + 0.5F * v.height : 0.5F * ImGui::GetIO().DisplaySize.y;
}

CardPlace card_below(const ViewRect& picture) {
  constexpr float kBar = 136.0F;
  constexpr float kRoom = 200.0F;
  const float bottom = picture.y + picture.height;
  const float below = ImGui::GetIO().DisplaySize.y - bottom;
  if (below > kBar + kRoom) return {bottom + kBar, 0.0F};
  return {bottom - 60.0F, 1.0F};
}

void card_title(const Look& look, ImU32 mark, Icon icon, const std::string& title) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  float x = at.x;
  if (icon != Icon::kNone) {
    draw_icon(*ImGui::GetWindowDrawList(), icon, {x + 8.0F, at.y + 10.0F}, 16.0F, mark);
    x += 24.0F;
  }
  const std::string shown = fitted(look.fonts.medium, title, width - (x - at.x) - 28.0F);
  draw_text(*ImGui::GetWindowDrawList(), look.fonts.medium, {x, at.y + 2.0F}, look.theme->text,
            shown.c_str());
  ImGui::Dummy({width, 20.0F});
}

bool card_closed(const Look& look) {
  const ImVec2 corner(ImGui::GetWindowPos().x + ImGui::GetWindowSize().x - 38.0F,
                      ImGui::GetWindowPos().y + 12.0F);
  ImGui::SetCursorScreenPos(corner);
  const bool closed =
      button(look, "close", Icon::kCross, "", ButtonKind::kGhost, 26.0F, 26.0F, "Close (Esc)");
  return closed;
}

}  // namespace substep::ui
