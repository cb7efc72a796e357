#include "app/ui/vector_figure.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/xml_text.hpp"
#include "core/model/number_text.hpp"

namespace substep::ui {
namespace {

// Size of the em square of Inter, as a share of the height of its lines: fonts of Dear ImGui have
// the latter, those of SVG the former.
constexpr float kEm = 2048.0F / (1984.0F + 494.0F);

struct NotedText {
  const ImDrawList* draw = nullptr;
  const ImFont* font = nullptr;
  ImVec2 at;
  float width = 0.0F;  // of its only line, 0: that of the font
  ImVec4 clip;
  ImU32 color = 0;
  std::string text;
};

std::vector<NotedText> noted;
bool noting = false;

std::string number(float value) {
  return number_text(std::round(100.0 * static_cast<double>(value)) / 100.0);
}

/// fill="#rrggbb", with fill-opacity if it is translucent.
std::string fill(ImU32 color) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = " fill=\"#";
  for (const int shift : {IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT}) {
    text += kDigits[(color >> (shift + 4)) & 0xfU];
    text += kDigits[(color >> shift) & 0xfU];
  }
  text += '"';
  const ImU32 alpha = color >> IM_COL32_A_SHIFT;
  if (alpha < 255U) text += " fill-opacity=\"" + number(static_cast<float>(alpha) / 255.0F) + '"';
  return text;
}

/// The window that draws a list, or null.
const ImGuiWindow* window_of(const ImDrawList& list) {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (window->DrawList == &list) return window;
  }
  return nullptr;
}

class Writer {
 public:
  Writer(const Look& look, const WindowPart& part) : look_(look), area_(part) {}

  void add_window(const ImGuiWindow& window) {
    const ImDrawList& list = *window.DrawList;
    view_ = window.InnerClipRect;
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback == nullptr) add_command(list, command);
    }
    for (const NotedText& text : noted) {
      if (text.draw == &list) add_text(text);
    }
    close_path();
  }

  std::string finish() {
    set_clip({0.0F, 0.0F, 0.0F, 0.0F});
    return std::move(body_);
  }

 private:
  void add_command(const ImDrawList& list, const ImDrawCmd& command) {
    if (!set_clip(command.ClipRect)) return;
    const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
      std::array<ImDrawVert, 3> v;
      for (unsigned k = 0; k < 3; ++k) {
        const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)];
        v[k] = list.VtxBuffer[static_cast<int>(command.VtxOffset + index)];
      }
      const bool solid =
          std::all_of(v.begin(), v.end(), [&](const ImDrawVert& one) { return one.uv == white; });
      if (solid) add_triangle(v);  // glyphs are written as text
    }
    close_path();
  }

  /// One path for neighbours of one colour: no seams between them.
  void add_triangle(std::array<ImDrawVert, 3> v) {
    const ImU32 color = v[0].col;
    if (color >> IM_COL32_A_SHIFT == 0U || !touches(v)) return;
    const ImVec2 a = v[1].pos - v[0].pos;
    const ImVec2 b = v[2].pos - v[0].pos;
    const float twice_area = a.x * b.y - a.y * b.x;
    if (twice_area == 0.0F) return;
    if (twice_area < 0.0F) std::swap(v[1], v[2]);  // one orientation: overlaps do not cancel
    if (color != path_color_) {
      close_path();
      path_color_ = color;
    }
    path_ += 'M' + point(v[0].pos) + 'L' + point(v[1].pos) + ' ' + point(v[2].pos) + 'Z';
  }

  [[nodiscard]] bool touches(const std::array<ImDrawVert, 3>& v) const {
    const auto [left, right] = std::minmax({v[0].pos.x, v[1].pos.x, v[2].pos.x});
    const auto [top, bottom] = std::minmax({v[0].pos.y, v[1].pos.y, v[2].pos.y});
    return right > area_.x && left < area_.x + area_.width && bottom > area_.y &&
           top < area_.y + area_.height;
  }

  void close_path() {
    if (!path_.empty()) body_ += "<path" + fill(path_color_) + " d=\"" + path_ + "\"/>\n";
    path_.clear();
    path_color_ = 0;
  }

  void add_text(const NotedText& text) {
    const float size = text.font->FontSize * ImGui::GetIO().FontGlobalScale;
    const bool inside = text.at.x < area_.x + area_.width && text.at.y < area_.y + area_.height &&
                        text.at.y + size > area_.y;
    if (!inside || !set_clip(text.clip)) return;
    ImVec2 at(text.at.x, text.at.y + text.font->Ascent * ImGui::GetIO().FontGlobalScale);
    std::string_view rest = text.text;
    for (std::size_t end = 0; end != std::string_view::npos; at.y += size) {
      end = rest.find('\n');
      add_line(text, at, rest.substr(0, end));
      if (end != std::string_view::npos) rest.remove_prefix(end + 1);
    }
  }

  /// @param at left end of the base line
  void add_line(const NotedText& text, ImVec2 at, std::string_view line) {
    if (line.find_first_not_of(' ') == std::string_view::npos) return;
    const float size = text.font->FontSize * ImGui::GetIO().FontGlobalScale;
    const float width =
        text.width > 0.0F
            ? text.width
            : text.font->CalcTextSizeA(size, 1e6F, 0.0F, line.data(), line.data() + line.size()).x;
    const bool bold = text.font != look_.fonts.regular && text.font != look_.fonts.small;
    body_ += "<text x=\"" + number(at.x - area_.x) + "\" y=\"" + number(at.y - area_.y) +
             "\" font-size=\"" + number(kEm * size) + "\" textLength=\"" + number(width) + '"' +
             (bold ? " font-weight=\"600\"" : "") + fill(text.color) + '>' + xml_text(line) +
             "</text>\n";
  }

  /// Opens a group with this clip rectangle, unless it is open. If it ends at the edge of
  /// the visible part of the window, it is extended to the edge of the figure. @return whether it
  /// is visible
  bool set_clip(const ImVec4& rect) {
    if (rect == clip_) return visible_;
    close_path();
    if (visible_) body_ += "</g>\n";
    clip_ = rect;
    const float left = std::max(rect.x, area_.x);
    const float top = rect.y == view_.Min.y ? area_.y : std::max(rect.y, area_.y);
    const float right = std::min(rect.z, area_.x + area_.width);
    const float end = area_.y + area_.height;
    const float bottom = rect.w == view_.Max.y ? end : std::min(rect.w, end);
    visible_ = left < right && top < bottom;
    if (!visible_) return false;
    const std::string id = "c" + std::to_string(++clips_);
    body_ += "<clipPath id=\"" + id + "\"><rect x=\"" + number(left - area_.x) + "\" y=\"" +
             number(top - area_.y) + "\" width=\"" + number(right - left) + "\" height=\"" +
             number(bottom - top) + "\"/></clipPath>\n<g clip-path=\"url(#" + id + ")\">\n";
    return true;
  }

  [[nodiscard]] std::string point(ImVec2 p) const {
    return number(p.x - area_.x) + ' ' + number(p.y - area_.y);
  }

  const Look& look_;
  const ViewRect area_;
  ImRect view_;  // of the window
  std::string body_;
  std::string path_;
  ImU32 path_color_ = 0;
  ImVec4 clip_{0.0F, 0.0F, 0.0F, 0.0F};
  bool visible_ = false;  // a group is open
  int clips_ = 0;
};

}  // namespace

FigureFrame::FigureFrame() {
  ImGui::GetStyle().AntiAliasedLines = false;
  ImGui::GetStyle().AntiAliasedFill = false;
  noted.clear();
  noting = true;
}

FigureFrame::~FigureFrame() {
  ImGui::GetStyle() = style_;
  noted.clear();
  noting = false;
}

void note_text(const ImDrawList& draw, const ImFont* font, ImVec2 at, float width, ImU32 color,
               std::string_view text) {
  if (!noting || text.empty()) return;
  const ImVec2 min = draw.GetClipRectMin();
  const ImVec2 max = draw.GetClipRectMax();
  const ImVec4 clip(min.x, min.y, max.x, max.y);
  noted.push_back({&draw, font, at, width, clip, color, std::string(text)});
}

WindowPart figure_window(const Look& paper, const Figure& figure) {
  constexpr double kPixels = 96.0 / 25.4;  // per millimetre, by CSS
  constexpr float kMargin = 4.0F;
  const auto width = static_cast<float>(kPixels * figure.millimetres);
  constexpr float kTall = 4000.0F;
  // Nothing is clipped at the edge of the display.
  ImVec2& visible = ImGui::GetMainViewport()->Size;
  const ImVec2 display = std::exchange(visible, {kTall, kTall});
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize({width, kTall});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {kMargin, kMargin});
  ImGui::Begin("##figure", nullptr,
               kPlaced | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  figure.draw(paper);
  const float height = ImGui::GetCursorScreenPos().y + kMargin;
  const WindowPart part{{0.0F, 0.0F, width, height}, ImGui::GetCurrentWindow()->RootWindow->ID};
  ImGui::End();
  ImGui::PopStyleVar();
  visible = display;
  return part;
}

std::string svg_figure(const Look& look, const ImDrawData& panels, const WindowPart& part,
                       double millimetres, const FigureNote& note) {
  Writer writer(look, part);
  for (const ImDrawList* list : panels.CmdLists) {
    const ImGuiWindow* window = window_of(*list);
    if (window != nullptr && window->RootWindow->ID == part.window) writer.add_window(*window);
  }
  const std::string width = number(part.width);
  const std::string height = number(part.height);
  const auto on_paper = [&](float pixels) {
    return number(pixels * static_cast<float>(millimetres) / part.width) + "mm";
  };
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + on_paper(part.width) +
         "\" height=\"" + on_paper(part.height) + "\" viewBox=\"0 0 " + width + ' ' + height +
         "\" font-family=\"Inter, system-ui, sans-serif\">\n<title>" + xml_text(note.title) +
         "</title>\n<desc>" + xml_text(note.command) + "</desc>\n<metadata>" +
         xml_text(note.experiment) + "</metadata>\n<rect width=\"" + width + "\" height=\"" +
         height + "\"" + fill(look.theme->panel | IM_COL32_A_MASK) + "/>\n" + writer.finish() +
         "</svg>\n";
}

}  // namespace substep::ui
