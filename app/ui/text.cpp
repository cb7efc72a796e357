// Text of the panels: alignment, fitting and wrapping, and section headings.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/vector_figure.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

ImVec2 snapped(ImVec2 p) {
  const float ratio = std::max(1.0F, ImGui::GetIO().DisplayFramebufferScale.x);
  return {std::round(p.x * ratio) / ratio, std::round(p.y * ratio) / ratio};
}

float size_of(const ImFont* font) { return font->FontSize * ImGui::GetIO().FontGlobalScale; }

void add_text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, std::string_view text) {
  draw.AddText(font, size_of(font), snapped(at), color, text.data(), text.data() + text.size());
}

const char* end_of_word(const char* p) {
  while (*p != '\0' && *p != ' ' && *p != '\n') ++p;
  return p;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Whether the text after a word is the unit of a number: a percent sign, or one or two letters,
// which distinguishes "0.8 %" and "10 s." from most other words.
bool is_unit_after(const char* word, const char* end) {
  if (end == word || *end != ' ' || !is_digit(end[-1]) || is_digit(end[1])) return false;
  const auto letters = std::count_if(end + 1, end_of_word(end + 1), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U && c != '.' && c != ',' && c != ';';
  });
  return letters == 1 || letters == 2;
}

// Not the unit after the comma: KJ would be kelvin joules, and MJ for mJ megajoules.
std::string capitals(std::string_view title) {
  std::string caps(title);
  for (char& c : caps) {
    if (c == ',') break;
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return caps;
}

// Capitals are more readable with letter spacing. @param draw null: only measures @return right end
float draw_capitals(const Look& look, ImVec2 at, const std::string& caps, ImDrawList* draw) {
  const ImVec2 start = at;
  for (const char* p = caps.c_str(); *p != '\0';) {
    const char* end = p + 1;
    while ((static_cast<unsigned char>(*end) & 0xc0U) == 0x80U) ++end;
    const std::string_view letter(p, static_cast<std::size_t>(end - p));
    if (draw != nullptr) add_text(*draw, look.fonts.caps, at, look.theme->dim, letter);
    at.x += text_size(look.fonts.caps, letter).x + 0.6F;
    p = end;
  }
  if (draw != nullptr) {
    note_text(*draw, look.fonts.caps, snapped(start), at.x - start.x, look.theme->dim, caps);
  }
  return at.x;
}

}  // namespace

void draw_text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, std::string_view text) {
  add_text(draw, font, at, color, text);
  note_text(draw, font, snapped(at), 0.0F, color, text);
}

void draw_text(ImFont* font, ImVec2 at, ImU32 color, std::string_view text) {
  draw_text(*ImGui::GetWindowDrawList(), font, at, color, text);
}

float draw_text_before(ImFont* font, ImVec2 right, ImU32 color, std::string_view text) {
  const float left = right.x - text_size(font, text).x;
  draw_text(font, {left, right.y}, color, text);
  return left;
}

ImVec2 text_size(const ImFont* font, std::string_view text) {
  return font->CalcTextSizeA(size_of(font), 1e6F, 0.0F, text.data(), text.data() + text.size());
}

std::string fitted(ImFont* font, const std::string& text, float width) {
  if (text_size(font, text).x <= width) return text;
  std::string cut = text;
  while (!cut.empty()) {
    // Whole characters only: continuation bytes are removed with their first one.
    while (cut.size() > 1 && (static_cast<unsigned char>(cut.back()) & 0xc0U) == 0x80U) {
      cut.pop_back();
    }
    cut.pop_back();
    while (!cut.empty() && cut.back() == ' ') cut.pop_back();
    if (text_size(font, (cut + "…")).x <= width) return cut + "…";
  }
  return "…";
}

std::string wrapped(ImFont* font, const std::string& text, float width) {
  std::string lines;
  std::string line;
  for (const char* p = text.c_str(); *p != '\0';) {
    const char* end = end_of_word(p);
    while (is_unit_after(p, end)) end = end_of_word(end + 1);
    const std::string word(p, end);
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && text_size(font, longer).x > width) {
      lines += line + '\n';
      line = word;
    } else {
      line = longer;
    }
    if (*end == '\n') {
      lines += line + '\n';
      line.clear();
    }
    p = *end == '\0' ? end : end + 1;
  }
  return lines + line;
}

void label(ImFont* font, ImU32 color, const std::string& text) {
  ImGui::PushFont(font);
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0.0F);  // for a word longer than a line
  const std::string lines = wrapped(font, text, ImGui::GetContentRegionAvail().x);
  note_text(*ImGui::GetWindowDrawList(), font, ImGui::GetCursorScreenPos(), 0.0F, color, lines);
  ImGui::TextUnformatted(lines.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void space(float height) {
  // Compensates for the item spacing of the item above and of the Dummy. The Dummy is needed: at
  // the end of a window the space would not count without an item.
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + height - 2.0F * ImGui::GetStyle().ItemSpacing.y);
  ImGui::Dummy({0.0F, 0.0F});
}

float heading_width(const Look& look, std::string_view title) {
  return draw_capitals(look, {0.0F, 0.0F}, capitals(title), nullptr);
}

void section(const Look& look, std::string_view title, std::string_view value, ImU32 value_color) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  constexpr float kHeight = 16.0F;
  const float x = draw_capitals(look, {origin.x, origin.y + 1.0F}, capitals(title), &draw);
  if (!value.empty()) {
    draw_text_before(look.fonts.small, {origin.x + width, origin.y},
                     value_color != 0 ? value_color : look.theme->text,
                     fitted(look.fonts.small, std::string(value), origin.x + width - x - 8.0F));
  }
  ImGui::Dummy({width, kHeight});
}

}  // namespace substep::ui
