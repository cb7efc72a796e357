#include "app/ui/widgets.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>

#include "app/ui/handles.hpp"

namespace substep::ui {
namespace {

constexpr float kTooltip = 300.0F;   // maximum width of its text
constexpr float kNameWidth = 76.0F;  // of the names on the left of rows

// Name on the left of a row, value on the right; the rest is for the control.
ImRect row_frame(const Look& look, const char* name, ImVec2 origin, float width) {
  const ImVec2 size = text_size(look.fonts.regular, name);
  draw_text(look.fonts.regular, {origin.x, origin.y + 0.5F * (look.m.row - size.y)},
            look.theme->dim, name);
  const float name_width = std::max(kNameWidth, size.x + 12.0F);  // of a long name
  return {origin.x + name_width, origin.y, origin.x + width, origin.y + look.m.row};
}

/// The scale of a slider: linear, logarithmic, or by power of ten. Dear ImGui's logarithmic sliders
/// stop where their format prints zero.
enum class TrackScale : std::uint8_t { kValue, kLogarithmic, kPower };

template <class T>
constexpr ImGuiDataType kDataType =
    std::is_same_v<T, double> ? ImGuiDataType_Double : ImGuiDataType_S32;

template <class T>
bool slide(const ImRect& frame, ImGuiID id, T& value, T least, T most, TrackScale track,
           const char* format, ImRect& grab) {
  if constexpr (std::is_same_v<T, double>) {
    if (track == TrackScale::kPower) {
      double power = std::log10(value);
      const double from = std::min(power, std::log10(least));
      const double to = std::max(power, std::log10(most));
      const bool changed = ImGui::SliderBehavior(frame, id, kDataType<T>, &power, &from, &to,
                                                 "%.1f", ImGuiSliderFlags_None, &grab);
      if (changed) value = std::pow(10.0, power);
      return changed;
    }
  }
  return ImGui::SliderBehavior(
      frame, id, kDataType<T>, &value, &least, &most, format,
      track == TrackScale::kLogarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None,
      &grab);
}

template <class T>
bool slider_row(const Look& look, const char* name, T& value, T least, T most, TrackScale track,
                const char* format, const char* tip) {
  constexpr float kValueWidth = 48.0F;
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  if (window->SkipItems) return false;
  // A text field shows its label beside it, except what follows "##".
  const std::string hidden = std::string("###") + name;
  const ImGuiID id = window->GetID(hidden.c_str());
  const ImVec2 origin = window->DC.CursorPos;
  const float width = ImGui::GetContentRegionAvail().x;
  const ImRect all(origin, {origin.x + width, origin.y + look.m.row});
  ImRect frame = row_frame(look, name, origin, width);
  const float value_x = frame.Max.x - kValueWidth;
  frame.Max.x = value_x - 8.0F;
  ImGui::ItemSize(all);
  if (!ImGui::ItemAdd(all, id, &all, ImGuiItemFlags_Inputable)) return false;
  mark(name, all.Min, all.Max);

  const bool hovered = ImGui::ItemHoverable(all, id, ImGuiItemFlags_None);
  const ImGuiIO& io = ImGui::GetIO();
  bool typing = ImGui::TempInputIsActive(id);
  if (!typing) {
    const bool clicked = hovered && ImGui::IsMouseClicked(0, id);
    ImGuiContext& g = *ImGui::GetCurrentContext();
    if (clicked || g.NavActivateId == id) {
      if (clicked) ImGui::SetKeyOwner(ImGuiKey_MouseLeft, id);
      const bool on_value = io.MousePos.x >= value_x;
      if ((clicked && (io.KeyCtrl || on_value)) ||
          (g.NavActivateId == id && (g.NavActivateFlags & ImGuiActivateFlags_PreferInput) != 0)) {
        typing = true;
      } else {
        ImGui::SetActiveID(id, window);
        ImGui::SetFocusID(id, window);
        ImGui::FocusWindow(window);
        g.ActiveIdUsingNavDirMask |= (1U << ImGuiDir_Left) | (1U << ImGuiDir_Right);
      }
    }
  }
  ImDrawList& draw = *window->DrawList;
  if (typing) {
    // Dear ImGui opens the field only if the click is in it; then it covers the number.
    const bool opens = !ImGui::TempInputIsActive(id);
    const ImRect box(opens ? all.Min.x : value_x - 16.0F, frame.Min.y, all.Max.x, frame.Max.y);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {6.0F, 0.5F * (look.m.row - ImGui::GetFontSize())});
    const bool typed = ImGui::TempInputScalar(box, id, hidden.c_str(), kDataType<T>, &value, format,
                                              &least, &most);
    ImGui::PopStyleVar();
    return typed;
  }
  ImRect grab;
  const float radius = 7.0F;
  ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, 2.0F * radius);
  const bool changed = slide(frame, id, value, least, most, track, format, grab);
  ImGui::PopStyleVar();
  if (changed) ImGui::MarkItemEdited(id);

  const Theme& t = *look.theme;
  const float y = std::round(0.5F * (frame.Min.y + frame.Max.y));
  const float x = std::clamp(grab.GetCenter().x, frame.Min.x + radius, frame.Max.x - radius);
  const bool active = ImGui::GetActiveID() == id;
  draw.AddRectFilled({frame.Min.x, y - 2}, {frame.Max.x, y + 2}, t.track, 2.0F);
  draw.AddRectFilled({frame.Min.x, y - 2}, {x, y + 2}, t.accent, 2.0F);
  if (active || hovered) draw.AddCircleFilled({x, y}, radius + 4, fade(t.accent, 0.25F));
  draw.AddCircleFilled({x, y}, radius, t.dark ? t.text : IM_COL32_WHITE);
  if (!t.dark) draw.AddCircle({x, y}, radius, t.accent, 0, 1.5F);

  std::array<char, 64> text{};
  ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), kDataType<T>, &value,
                              format);
  const float line = text_size(look.fonts.medium, text.data()).y;
  draw_text_before(look.fonts.medium, {all.Max.x, origin.y + 0.5F * (look.m.row - line)}, t.text,
                   text.data());
  draw_focus(look);
  if (!active) tooltip(look, name, tip);
  return changed;
}

struct TooltipLine {
  ImFont* font;
  ImU32 color;
  std::string text;
};

// At the pointer, inside the display. Dear ImGui places a tooltip by the size of the previous one;
// after a narrow one it would wrap the lines of each tooltip more narrowly than those of the last.
void place_tooltip(ImVec2 size) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const bool above = mouse.y + 20.0F + size.y > display.y - 8.0F;
  ImGui::SetNextWindowPos({std::max(8.0F, std::min(mouse.x + 16.0F, display.x - 8.0F - size.x)),
                           above ? std::max(8.0F, mouse.y - 8.0F - size.y) : mouse.y + 20.0F});
}

void show_lines(std::span<const TooltipLine> lines) {
  ImVec2 size(0.0F, 20.0F - 4.0F);
  for (const TooltipLine& line : lines) {
    const ImVec2 extent = text_size(line.font, line.text);
    size = {std::max(size.x, extent.x + 24.0F), size.y + extent.y + 4.0F};
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F, 10.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8.0F, 4.0F});
  place_tooltip(size);
  if (ImGui::BeginTooltip()) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + kTooltip);  // from the padding on, as measured
    for (const TooltipLine& line : lines) {
      ImGui::PushFont(line.font);
      ImGui::PushStyleColor(ImGuiCol_Text, line.color);
      ImGui::TextUnformatted(line.text.c_str());
      ImGui::PopStyleColor();
      ImGui::PopFont();
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  ImGui::PopStyleVar(2);
}

// Whether the last item was clicked since the pointer reached it, or appeared under the resting
// pointer after a click: a tooltip would then cover what the click has changed. With touch and
// keyboard the tooltip is always shown.
bool clicked_here() {
  const ImGuiIO& io = ImGui::GetIO();
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  const bool by_keyboard = g.NavDisableMouseHover && !g.NavDisableHighlight;
  if (io.MouseSource == ImGuiMouseSource_TouchScreen || by_keyboard) return false;
  constexpr float kSlack = 0.1F;  // Dear ImGui's timers lag by some frames [s]
  const auto ago = static_cast<float>(g.Time - io.MouseClickedTime[0]);
  return io.MouseClickedTime[0] > 0.0 && g.LastItemData.Rect.Contains(io.MouseClickedPos[0]) &&
         ago < std::max(g.MouseStationaryTimer, g.HoverItemDelayTimer) + kSlack;
}

}  // namespace

void draw_focus(const Look& look) {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.NavId != g.LastItemData.ID || g.NavDisableHighlight) return;
  const ImVec2 around(2.0F, 2.0F);
  ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin() - around,
                                      ImGui::GetItemRectMax() + around, look.theme->accent_hover,
                                      look.m.radius + 2, 0, 2.0F);
}

void read_out(const Look& look, std::span<const ReadOutLine> lines) {
  std::vector<TooltipLine> shown;
  for (const ReadOutLine& line : lines) {
    ImFont* font = line.title ? look.fonts.medium : look.fonts.small;
    shown.push_back({font, line.color, wrapped(font, line.text, kTooltip)});
  }
  show_lines(shown);
}

void tooltip(const Look& look, std::string_view title, std::string_view text) {
  if (text.empty()) return;
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal | ImGuiHoveredFlags_NoSharedDelay) ||
      clicked_here()) {
    return;
  }
  std::vector<TooltipLine> lines;
  if (!title.empty()) lines.push_back({look.fonts.medium, look.theme->text, std::string(title)});
  lines.push_back({look.fonts.regular, look.theme->dim,
                   wrapped(look.fonts.regular, std::string(text), kTooltip)});
  show_lines(lines);
}

bool segmented(const Look& look, const char* id, std::span<const Choice> choices, int& current,
               float width) {
  const Theme& t = *look.theme;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float height = look.m.row;
  draw.AddRectFilled(origin, {origin.x + width, origin.y + height}, t.well, look.m.radius);

  // Spare width is distributed evenly; if there is too little, the text is smaller.
  const auto words_in = [&](ImFont* f) {
    float sum = 0.0F;
    for (const Choice& choice : choices) sum += text_size(f, choice.name).x;
    return sum;
  };
  const float comfortable = width - 18.0F * static_cast<float>(choices.size());
  ImFont* font =
      words_in(look.fonts.medium) > comfortable ? look.fonts.small_medium : look.fonts.medium;
  const float words = words_in(font);
  const float extra = (width - words) / static_cast<float>(choices.size());
  bool changed = false;
  float x = origin.x;
  ImGui::PushID(id);
  for (int i = 0; i < static_cast<int>(choices.size()); ++i) {
    const Choice& choice = choices[static_cast<std::size_t>(i)];
    const ImVec2 size = text_size(font, choice.name);
    const float right = x + size.x + extra;
    const ImRect box({std::round(x), origin.y}, {std::round(right), origin.y + height});
    ImGui::SetCursorScreenPos(box.Min);
    ImGui::PushID(i);
    const bool pressed = marked_button("choice", box.GetSize(), choice.name, id);
    const bool hovered = ImGui::IsItemHovered();
    ImGui::PopID();
    if (pressed && i != current) {
      current = i;
      changed = true;
    }
    const bool on = i == current;
    if (on || hovered) {
      draw.AddRectFilled({box.Min.x + 2, box.Min.y + 2}, {box.Max.x - 2, box.Max.y - 2},
                         on ? t.accent : t.control, look.m.radius - 2);
    }
    draw_text(font, {x + 0.5F * (right - x - size.x), origin.y + 0.5F * (height - size.y)},
              on        ? t.on_accent
              : hovered ? t.text
                        : t.dim,
              choice.name);
    draw_focus(look);
    tooltip(look, choice.name, choice.tip);
    x = right;
  }
  ImGui::PopID();
  ImGui::SetCursorScreenPos(origin);
  ImGui::Dummy({width, height});
  return changed;
}

bool segmented_row(const Look& look, const char* name, std::span<const Choice> choices,
                   int& current, const char* tip) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImRect frame = row_frame(look, name, origin, width);
  // If the choices would overlap, they take the width left by the name.
  float words = 0.0F;
  for (const Choice& choice : choices) {
    words += text_size(look.fonts.small_medium, choice.name).x + 10.0F;
  }
  const float name_end = origin.x + text_size(look.fonts.regular, name).x + 12.0F;
  frame.Min.x = std::clamp(frame.Max.x - words, std::min(name_end, frame.Min.x), frame.Min.x);
  ImGui::Dummy({frame.Min.x - origin.x - 8.0F, look.m.row});
  tooltip(look, name, tip);
  ImGui::SetCursorScreenPos(frame.Min);
  return segmented(look, name, choices, current, frame.GetWidth());
}

bool slider(const Look& look, const char* name, double& value, double least, double most,
            bool logarithmic, const char* format, const char* tip) {
  return slider_row(look, name, value, least, most,
                    logarithmic ? TrackScale::kLogarithmic : TrackScale::kValue, format, tip);
}
bool power_slider(const Look& look, const char* name, double& value, double least, double most,
                  const char* tip) {
  return slider_row(look, name, value, least, most, TrackScale::kPower, "%.2g", tip);
}
bool slider(const Look& look, const char* name, int& value, int least, int most, bool logarithmic,
            const char* tip) {
  return slider_row(look, name, value, least, most,
                    logarithmic ? TrackScale::kLogarithmic : TrackScale::kValue, "%d", tip);
}

void checkbox(const Look& look, const char* name, bool& value, const char* tip) {
  const Theme& t = *look.theme;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  if (marked_button(name, {ImGui::GetContentRegionAvail().x, look.m.row}, name)) value = !value;
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  constexpr float kSize = 16.0F;
  const ImVec2 at(origin.x, origin.y + 0.5F * (look.m.row - kSize));
  const ImVec2 to = at + ImVec2(kSize, kSize);
  if (value) {
    draw.AddRectFilled(at, to, hovered ? t.accent_hover : t.accent, 4.0F);
    draw_icon(draw, Icon::kCheck, {at.x + 0.5F * kSize, at.y + 0.5F * kSize}, kSize, t.on_accent);
  } else {
    draw.AddRectFilled(at, to, t.well, 4.0F);
    draw.AddRect(at, to, hovered ? t.dim : t.faint, 4.0F);
  }
  const float line = text_size(look.fonts.regular, name).y;
  draw_text(look.fonts.regular, {to.x + 8.0F, origin.y + 0.5F * (look.m.row - line)}, t.text, name);
  draw_focus(look);
  tooltip(look, name, tip);
}

}  // namespace substep::ui
