#include <imgui_internal.h>

#include <algorithm>
#include <string>

#include "app/ui/handles.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

// The popup opens below its button, or above if there is more room, and never covers it.
bool open_menu(const ImRect& box, const std::function<void()>& menu) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float below = display.y - box.Max.y - 16.0F;
  const float above = box.Min.y - 16.0F;
  const bool up = below < 240.0F && above > below;
  const bool left = box.Min.x > display.x - 220.0F;  // extends towards the side with room
  ImGui::SetNextWindowPos({left ? box.Max.x : box.Min.x, up ? box.Min.y - 4.0F : box.Max.y + 4.0F},
                          ImGuiCond_Always, {left ? 1.0F : 0.0F, up ? 1.0F : 0.0F});
  const float room = left ? box.Max.x - 8.0F : display.x - box.Min.x - 8.0F;
  const float widest = std::max(box.GetWidth(), std::min(400.0F, room));
  ImGui::SetNextWindowSizeConstraints({box.GetWidth(), 0.0F},
                                      {widest, std::max(120.0F, up ? above : below)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {6.0F, 6.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 2.0F});
  const bool open = ImGui::BeginPopup("menu", ImGuiWindowFlags_NoMove);
  if (open) {
    menu();
    scroll_by_drag();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
  return open;
}

}  // namespace

bool button(const Look& look, const char* id, Icon icon, std::string_view text, ButtonKind kind,
            float width, float height, std::string_view tip) {
  const Theme& t = *look.theme;
  const ImVec2 size = text_size(look.fonts.medium, text);
  const float icon_width = icon == Icon::kNone ? 0.0F : 16.0F;
  const float between = icon_width > 0.0F && size.x > 0.0F ? 6.0F : 0.0F;
  const float content = icon_width + between + size.x;
  if (width <= 0.0F) width = size.x > 0.0F ? content + 24.0F : height;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 end = origin + ImVec2(width, height);
  const bool pressed = marked_button(id, {width, height}, text.empty() ? id : text);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImU32 ink = kind == ButtonKind::kPrimary ? t.on_accent : t.text;
  if (kind == ButtonKind::kPrimary) {
    // Less opaque rather than lighter: white text stays readable in both themes.
    draw.AddRectFilled(origin, end, hovered ? fade(t.accent, 0.88F) : t.accent, look.m.radius);
  } else if (kind == ButtonKind::kPlain || hovered) {
    draw.AddRectFilled(origin, end, hovered ? t.control_hover : t.control, look.m.radius);
  } else {
    ink = t.dim;
  }
  const float x = origin.x + 0.5F * (width - content);
  const float y = origin.y + 0.5F * height;
  if (icon != Icon::kNone) draw_icon(draw, icon, {x + 8.0F, y}, 16.0F, ink);
  draw_text(look.fonts.medium, {x + icon_width + between, y - 0.5F * size.y}, ink, text);
  draw_focus(look);
  tooltip(look, "", tip);
  return pressed;
}

bool progress(const Look& look, double share, const char* tip) {
  constexpr float kCancel = 64.0F;
  constexpr float kGap = 12.0F;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float bar = ImGui::GetContentRegionAvail().x - kCancel - kGap;
  const float y = at.y + 0.5F * look.m.row;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({at.x, y - 3.0F}, {at.x + bar, y + 3.0F}, look.theme->track, 3.0F);
  draw.AddRectFilled({at.x, y - 3.0F},
                     {at.x + std::max(6.0F, bar * static_cast<float>(share)), y + 3.0F},
                     look.theme->accent, 3.0F);
  ImGui::SetCursorScreenPos({at.x + bar + kGap, at.y});
  ImGui::PushID(tip);  // a panel may contain two
  const bool pressed =
      button(look, "cancel", Icon::kNone, "Cancel", ButtonKind::kPlain, kCancel, look.m.row, tip);
  ImGui::PopID();
  return pressed;
}

void toggle(const Look& look, const char* name, bool& value, ImU32 mark, bool first,
            std::string_view tip) {
  const Theme& t = *look.theme;
  const ImVec2 size = text_size(look.fonts.small_medium, name);
  const float dot = mark != 0 ? 12.0F : 0.0F;
  const float width = size.x + dot + 18.0F;
  constexpr float kGap = 6.0F;
  const float height = look.m.row;
  if (!first) {
    ImGui::SameLine(0.0F, kGap);
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  }
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 end = origin + ImVec2(width, height);
  if (marked_button(name, {width, height}, name)) value = !value;
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(origin, end, value ? fade(t.accent, t.dark ? 0.32F : 0.14F) : t.well,
                     0.5F * height);
  draw.AddRect(origin, end, value ? t.accent : hovered ? t.dim : t.track, 0.5F * height);
  const float middle = origin.y + 0.5F * height;
  if (mark != 0)
    draw.AddCircleFilled({origin.x + 13.0F, middle}, 3.5F, fade(mark, value ? 1 : 0.6F));
  draw_text(look.fonts.small_medium, {origin.x + 9.0F + dot, middle - 0.5F * size.y},
            value || hovered ? t.text : t.dim, name);
  draw_focus(look);
  tooltip(look, name, tip);
}

void fold(const Look& look, const std::string& title, bool& open, std::string_view tip) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  constexpr float kHeight = 24.0F;
  ImGui::PushID(title.c_str());
  if (marked_button("fold", {width, kHeight}, title)) open = !open;
  ImGui::PopID();
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 ink = hovered ? look.theme->text : look.theme->dim;
  const float line = text_size(look.fonts.regular, title).y;
  draw_text(look.fonts.regular, {origin.x, origin.y + 0.5F * (kHeight - line)}, ink, title);
  draw_icon(draw, open ? Icon::kChevronUp : Icon::kChevron,
            {origin.x + width - 10.0F, origin.y + 0.5F * kHeight}, 16.0F, ink);
  draw_focus(look);
  tooltip(look, title, tip);
}

bool menu_button(const Look& look, const char* id, const std::string& text, float width,
                 float height, std::string_view tip, const std::function<void()>& menu) {
  const Theme& t = *look.theme;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  ImGui::PushID(id);
  const bool pressed = marked_button("open", {width, height}, id);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImRect box(origin, origin + ImVec2(width, height));
  draw.AddRectFilled(box.Min, box.Max, hovered ? t.control_hover : t.control, look.m.radius);
  const std::string shown = fitted(look.fonts.medium, text, width - 40.0F);
  const float line = text_size(look.fonts.medium, shown).y;
  draw_text(look.fonts.medium, {origin.x + 12.0F, origin.y + 0.5F * (height - line)}, t.text,
            shown);
  draw_icon(draw, Icon::kChevron, {box.Max.x - 16.0F, origin.y + 0.5F * height}, 16.0F, t.dim);
  draw_focus(look);
  tooltip(look, "", tip);
  if (pressed) ImGui::OpenPopup("menu");
  const bool open = open_menu(box, menu);
  ImGui::PopID();
  return open;
}

bool icon_menu(const Look& look, const char* id, Icon icon, ButtonKind kind, float size,
               const char* tip, const std::function<void()>& menu) {
  ImGui::PushID(id);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImRect box(at, at + ImVec2(size, size));
  if (button(look, "open", icon, "", kind, size, size, tip)) ImGui::OpenPopup("menu");
  mark(id, box.Min, box.Max);
  const bool open = open_menu(box, menu);
  ImGui::PopID();
  return open;
}

bool menu_item(const Look& look, const std::string& text, std::string_view note, bool current,
               const MenuPicture* picture) {
  const Theme& t = *look.theme;
  const ImVec2 size = text_size(look.fonts.regular, text);
  const ImVec2 note_size = text_size(look.fonts.small, note);
  constexpr float kPad = 4.0F;  // around the picture
  const float left = 28.0F + (picture != nullptr ? picture->size.x + 10.0F : 0.0F);
  const float needed = left + size.x + (note_size.x > 0.0F ? note_size.x + 24.0F : 0.0F) + 8.0F;
  const float width = std::max(needed, ImGui::GetContentRegionAvail().x);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float height =
      std::max(look.m.row + 2.0F, picture != nullptr ? picture->size.y + kPad : 0.0F);
  const bool pressed = marked_button(text.c_str(), {width, height}, text);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered() || ImGui::IsItemFocused()) {
    draw.AddRectFilled(origin, origin + ImVec2(width, height), t.control, look.m.radius);
  }
  const float middle = origin.y + 0.5F * height;
  if (current) draw_icon(draw, Icon::kCheck, {origin.x + 14.0F, middle}, 16.0F, t.accent_hover);
  if (picture != nullptr && ImGui::IsItemVisible()) {
    const ImVec2 corner(origin.x + 28.0F, middle - 0.5F * picture->size.y);
    picture->draw(draw, corner, corner + picture->size);
  }
  draw_text(look.fonts.regular, {origin.x + left, middle - 0.5F * size.y}, t.text, text);
  draw_text_before(look.fonts.small, {origin.x + width - 8.0F, middle - 0.5F * note_size.y}, t.dim,
                   note);
  if (pressed) ImGui::CloseCurrentPopup();
  return pressed;
}

}  // namespace substep::ui
