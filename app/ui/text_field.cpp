#include "app/ui/text_field.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "app/lab/text_history.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr ImVec2 kFieldPadding(8.0F, 6.0F);

std::size_t lines_of(const char* text) {
  std::size_t lines = 1;
  for (const char* at = std::strchr(text, '\n'); at != nullptr; at = std::strchr(at + 1, '\n')) {
    ++lines;
  }
  return lines;
}

/// Dear ImGui draws the text of a field in a child window of the same id.
const ImGuiWindow* child_of(ImGuiID id) {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (window->ChildId == id) return window;
  }
  return nullptr;
}

}  // namespace

void TextField::show(const std::string& text) {
  if (active_) {
    next_ = text;
    return;
  }
  buffer_.resize(most_ + 1);
  const std::size_t size = std::min(text.size(), most_);
  std::copy_n(text.begin(), size, buffer_.begin());
  buffer_[size] = '\0';
}

void TextField::go_to(std::size_t offset) {
  cursor_ = offset;
  wants_keyboard_ = true;
}

bool TextField::draw(const Look& look, const char* label, ImVec2 size,
                     std::span<const LineMark> marks) {
  if (buffer_.empty()) show("");
  const Theme& t = *look.theme;
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 to = from + size;
  const std::string digits = std::to_string(lines_of(buffer_.data()));
  const float gutter = text_size(look.fonts.small, digits).x + 22.0F;
  ImGui::GetWindowDrawList()->AddRectFilled(from, to, t.well, look.m.radius);

  ImGui::SetCursorScreenPos({from.x + gutter, from.y});
  const std::string hidden = std::string("##") + label;
  const ImGuiID id = ImGui::GetID(hidden.c_str());
  ImGuiContext& g = *ImGui::GetCurrentContext();
  active_ = g.ActiveId == id;
  if (wants_keyboard_ && !active_) {
    g.NavNextActivateId = id;
    g.NavNextActivateFlags = ImGuiActivateFlags_PreferInput | ImGuiActivateFlags_TryToPreserveState;
  }
  wants_keyboard_ = false;
  // Esc leaves the field. Dear ImGui would undo all that was typed in it.
  if (active_ && ImGui::IsKeyPressed(ImGuiKey_Escape, false)) ImGui::ClearActiveID();

  ImGui::PushFont(look.fonts.regular);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, IM_COL32_BLACK_TRANS);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, kFieldPadding);
  // The owner undoes changes, also those that are not of the keyboard.
  const bool changed = ImGui::InputTextMultiline(
      hidden.c_str(), buffer_.data(), buffer_.size(), {size.x - gutter, size.y},
      ImGuiInputTextFlags_NoUndoRedo | ImGuiInputTextFlags_CallbackAlways, edited, this);
  const float line = ImGui::GetFontSize();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  ImGui::PopFont();
  active_ = g.ActiveId == id;
  if (!active_ && next_) show(*std::exchange(next_, std::nullopt));
  mark(label, {from.x + gutter, from.y}, to);

  const ImGuiWindow* child = child_of(id);
  if (child != nullptr) {
    const float first = child->Pos.y + kFieldPadding.y - child->Scroll.y;
    draw_lines(look, from, to, gutter, first, marks);
    // The numbers tell the marks of their lines.
    const float y = ImGui::GetIO().MousePos.y;
    const auto hovered = static_cast<std::size_t>(std::max(0.0F, (y - first) / line) + 1.0F);
    ImGui::SetCursorScreenPos(from);
    ImGui::PushID(label);
    ImGui::InvisibleButton("numbers", {gutter, size.y});
    ImGui::PopID();
    for (const LineMark& mark : marks) {
      if (mark.line != hovered) continue;
      tooltip(look, "Line " + std::to_string(mark.line), mark.text);
      break;
    }
  }
  ImGui::SetCursorScreenPos(from);
  ImGui::Dummy(size);
  return changed;
}

// The child window of the text is drawn over this.
void TextField::draw_lines(const Look& look, ImVec2 from, ImVec2 to, float gutter, float first_line,
                           std::span<const LineMark> marks) const {
  const Theme& t = *look.theme;
  const float line = look.fonts.regular->FontSize * ImGui::GetIO().FontGlobalScale;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(from, to, true);
  const std::size_t count = lines_of(buffer_.data());
  const auto top_of = [&](std::size_t number) {
    return first_line + line * static_cast<float>(number - 1);
  };
  std::vector<std::size_t> marked;
  for (const LineMark& of : marks) {
    if (!marked.empty() && marked.back() == of.line) continue;
    marked.push_back(of.line);
    const float y = top_of(of.line);
    if (y + line < from.y || y > to.y) continue;
    draw.AddRectFilled({from.x, y}, {to.x, y + line}, fade(t.orange, t.dark ? 0.2F : 0.14F));
    draw.AddRectFilled({from.x, y}, {from.x + 3.0F, y + line}, t.orange);
    mark("marked line " + std::to_string(of.line), {from.x, y}, {from.x + gutter, y + line},
         "line");
  }
  const float above = std::max(0.0F, std::floor((from.y - first_line) / line));
  for (auto i = static_cast<std::size_t>(above) + 1; i <= count && top_of(i) < to.y; ++i) {
    const bool is_marked = std::binary_search(marked.begin(), marked.end(), i);
    const std::string number = std::to_string(i);
    const float high = text_size(look.fonts.small, number).y;
    draw_text_before(look.fonts.small, {from.x + gutter - 8.0F, top_of(i) + 0.5F * (line - high)},
                     is_marked ? t.orange : t.dim, number);
  }
  draw.PopClipRect();
}

int TextField::edited(ImGuiInputTextCallbackData* data) {
  static_cast<TextField*>(data->UserData)->complete(*data);
  return 0;
}

// What the field does beside the keys that Dear ImGui handles.
void TextField::complete(ImGuiInputTextCallbackData& data) {
  if (next_) {
    const std::string_view shown(data.Buf, static_cast<std::size_t>(data.BufTextLen));
    const TextChange change = difference(shown, *next_);
    const auto at = static_cast<int>(change.at);
    data.DeleteChars(at, static_cast<int>(change.removed.size()));
    data.InsertChars(at, change.inserted.data(), change.inserted.data() + change.inserted.size());
    data.CursorPos = at + static_cast<int>(change.inserted.size());
    data.ClearSelection();
    next_.reset();
  } else {
    indent(data);
  }
  if (cursor_) {
    data.CursorPos = std::min(static_cast<int>(*cursor_), data.BufTextLen);
    data.ClearSelection();
    cursor_.reset();
  }
  length_ = static_cast<std::size_t>(data.BufTextLen);
}

// A new line begins below the one before it, and further to the right after an opening bracket.
void TextField::indent(ImGuiInputTextCallbackData& data) {
  const auto cursor = static_cast<std::size_t>(data.CursorPos);
  const std::string_view before(data.Buf, cursor);
  if (!ImGui::IsKeyPressed(ImGuiKey_Enter) || !before.ends_with('\n') ||
      static_cast<std::size_t>(data.BufTextLen) != length_ + 1) {
    return;
  }
  const std::string_view above = before.substr(0, cursor - 1);
  const std::size_t newline = above.rfind('\n');
  const std::string_view last =
      newline == std::string_view::npos ? above : above.substr(newline + 1);
  std::string spaces(std::min(last.find_first_not_of(' '), last.size()), ' ');
  if (last.ends_with('{') || last.ends_with('[')) spaces += "  ";
  if (!spaces.empty()) data.InsertChars(data.CursorPos, spaces.c_str());
}

}  // namespace substep::ui
