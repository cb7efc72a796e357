#pragma once
// Labels in a plot: names of curves, levels and moments.

#include <optional>
#include <string>

#include "app/ui/plot.hpp"
#include "app/ui/plot_curves.hpp"

namespace substep::ui {

/// Text on a background, so that curves do not cross it.
void draw_on_ground(const Look& look, ImDrawList& draw, ImVec2 at, ImU32 color,
                    const std::string& text, float opacity = 0.75F);

/// Position of a name at a curve's end. Earlier names have priority.
struct NamePlace {
  float y = 0.0F;     // middle of the text
  bool shown = true;  // whether there is room
};
/// Moves names apart by as little as possible so that they do not overlap; names that do not fit
/// are hidden, the last first. @param line height of a name
std::vector<NamePlace> apart(const std::vector<float>& wanted, float line, float top, float bottom);

/// Dashed lines across the plot, with their names.
void draw_levels(const Look& look, const PlotSpec& spec, const PlotFrame& f, ImDrawList& draw);
/// Dashed vertical lines at moments, with their names.
void draw_marks(const Look& look, const PlotSpec& spec, const PlotFrame& f, ImDrawList& draw);
/// The name of each curve at its end.
void draw_names(const Look& look, const PlotSpec& spec, const PlotFrame& f, ImDrawList& draw);
/// The time at the cursor, among the labels of the time axis.
struct TimeLabel {
  std::string text;
  ImVec2 size;
  float left = 0.0F;
};
/// Nothing without a cursor.
std::optional<TimeLabel> cursor_time(const Look& look, const PlotFrame& f, const TimeAxis& axis);
void draw_cursor_time(const Look& look, const PlotFrame& f, const TimeLabel& label,
                      ImDrawList& draw);

}  // namespace substep::ui
