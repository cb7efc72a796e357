#include "app/ui/card.hpp"

#include <algorithm>
#include <vector>

#include "app/ui/over_picture.hpp"

namespace substep::ui {
namespace {

/// Area of the moving bodies within a part of the display [pixel^2].
float covered(const Session& session, const Viewport& viewport, ImVec2 min, ImVec2 max) {
  float area = 0.0F;
  for (std::size_t i = 0; i < session.scene().bodies.size(); ++i) {
    const Body& body = session.scene().bodies[i];
    const Vec3& x = session.poses().x[i];
    ImVec2 p;
    if (body.is_static || !project(viewport, x, p)) continue;
    const auto r =
        static_cast<float>(radius_around(body.shape) / std::max(pixel_size(viewport, x), 1e-9));
    const float width = std::min(max.x, p.x + r) - std::max(min.x, p.x - r);
    const float height = std::min(max.y, p.y + r) - std::max(min.y, p.y - r);
    area += std::max(0.0F, width) * std::max(0.0F, height);
  }
  return area;
}

}  // namespace

bool begin_card(const Look& look, const char* id, float width, const CardPlace& place) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  width = std::min(width, display.x - 24.0F);
  const float x = std::clamp(place.x, 12.0F + 0.5F * width, display.x - 12.0F - 0.5F * width);
  ImGui::SetNextWindowPos({x, place.y}, ImGuiCond_Always, {0.5F, place.pivot});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, display.y - 96.0F});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, look.theme->raised);
  const bool open = ImGui::Begin(id, nullptr, kPlaced | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleColor();
  return open;
}

CardPlace card_middle(const Viewport& viewport) {
  constexpr float kRoom = 560.0F;
  const ViewRect& v = viewport.view_rect;
  const float y = v.height > kRoom ? v.y + 0.5F * v.height : 0.5F * ImGui::GetIO().DisplaySize.y;
  return {y, 0.5F, v.x + 0.5F * v.width};
}

CardPlace card_below(const ViewRect& picture) {
  constexpr float kBar = 136.0F;
  constexpr float kRoom = 200.0F;
  const float bottom = picture.y + picture.height;
  const float below = ImGui::GetIO().DisplaySize.y - bottom;
  const float middle = picture.x + 0.5F * picture.width;
  if (below > kBar + kRoom) return {bottom + kBar, 0.0F, middle};
  return {bottom - 60.0F, 1.0F, middle};
}

CardPlace card_beside(const Session& session, const Viewport& viewport, ImVec2 size, int& which) {
  constexpr float kCaption = 76.0F;
  const ViewRect& v = viewport.view_rect;
  const CardPlace below = card_below(v);
  if (below.pivot == 0.0F) return below;  // not over the picture
  const float left = v.x + 12.0F + 0.5F * size.x;
  const float right = v.x + v.width - 12.0F - 0.5F * size.x;
  const float top = v.y + kCaption;
  const float over_controls = 12.0F + 0.5F * size.x;
  const float over_plots = ImGui::GetIO().DisplaySize.x - over_controls;
  // By their upper edges: a card that grows does not move what it shows already.
  const float low = below.y - size.y;
  const std::vector<CardPlace> places{
      {low, 0.0F, below.x}, {low, 0.0F, left},          {low, 0.0F, right},     {top, 0.0F, left},
      {top, 0.0F, right},   {low, 0.0F, over_controls}, {low, 0.0F, over_plots}};
  if (which < 0) {
    float least = 0.0F;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const CardPlace& place = places[i];
      const ImVec2 min(place.x - 0.5F * size.x, place.y);
      const float area = covered(session, viewport, min, min + size);
      if (i > 0 && area >= least) continue;
      least = area;
      which = static_cast<int>(i);
    }
  }
  return places[static_cast<std::size_t>(which)];
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
  draw_text(look.fonts.medium, {x, at.y + 2.0F}, look.theme->text, shown);
  ImGui::Dummy({width, 20.0F});
}

bool card_closed(const Look& look) {
  const ImVec2 corner(ImGui::GetWindowPos().x + ImGui::GetWindowSize().x - 38.0F,
                      ImGui::GetWindowPos().y + 12.0F);
  ImGui::SetCursorScreenPos(corner);
  return button(look, "close", Icon::kCross, "", ButtonKind::kGhost, 26.0F, 26.0F, "Close (Esc)");
}

}  // namespace substep::ui
