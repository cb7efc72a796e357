#pragma once
// What is written into a plot: the names of its curves, levels and moments.

#include "app/ui/plot.hpp"
#include "app/ui/plot_curves.hpp"

namespace substep::ui {

/// A name to be written beside a curve's end. Where room is scarce the first come first.
struct NamePlace {
  float y = 0.0F;     // middle of the text
  bool shown = true;  // there is room
};
/// Moves names apart so that none covers another, as little as it takes; those for which there is
/// no room are not shown, the last first. @param line height of a name
std::vector<NamePlace> apart(const std::vector<float>& wanted, float line, float top, float bottom);

/// Dashed lines across the plot, and what they stand for. @param from what is earlier is left out
/// [s]
void draw_levels(const Look& look, const PlotSpec& spec, double from, const PlotFrame& f,
                 ImDrawList& draw);
/// Dashed lines at moments, with their names.
void draw_marks(const Look& look, const PlotSpec& spec, double from, const PlotFrame& f,
                ImDrawList& draw);
/// The name of each curve where it ends. @param from what is earlier is left out [s]
void draw_names(const Look& look, const PlotSpec& spec, double from, const PlotFrame& f,
                ImDrawList& draw);
/// The time at the cursor, over the labels of the time axis.
void draw_cursor_time(const Look& look, const PlotFrame& f, const TimeAxis& axis, ImDrawList& draw);

}  // namespace substep::ui
