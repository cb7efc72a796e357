#pragma once
// A part of the window as SVG: shapes as paths, text as text, and the experiment as metadata.

#include <imgui.h>

#include <string>
#include <string_view>

#include "app/ui/desk.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// Stores the text of the next frame, and draws shapes without antialiasing: a figure is built from
/// both. The previous style is restored when this is destroyed.
class FigureFrame {
 public:
  FigureFrame();
  ~FigureFrame();
  FigureFrame(const FigureFrame&) = delete;
  FigureFrame& operator=(const FigureFrame&) = delete;

 private:
  ImGuiStyle style_ = ImGui::GetStyle();
};

/// Called for every text; keeps it if a FigureFrame exists.
/// @param width of its only line, 0: that of the font
void note_text(const ImDrawList& draw, const ImFont* font, ImVec2 at, float width, ImU32 color,
               std::string_view text);

/// Metadata of a figure, for people and programs.
struct FigureNote {
  std::string title;
  std::string command;     // line of the command line that runs it
  std::string experiment;  // JSON
};

/// Draws a figure in a window of its own; call between ImGui::NewFrame() and Render().
/// @return the figure in that window, for svg_figure()
WindowPart figure_window(const Look& paper, const Figure& figure);

/// The contents of a window within an area, also beyond the edge of the display.
/// @param panels of a frame drawn within a FigureFrame  @param part in interface pixels
std::string svg_figure(const Look& look, const ImDrawData& panels, const WindowPart& part,
                       double millimetres, const FigureNote& note);

}  // namespace substep::ui
