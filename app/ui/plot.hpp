#pragma once

#include <imgui.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/history.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// The time that all plots show together, and where the pointer is on it.
struct TimeAxis {
  double span = 10.0;                // [s]
  std::optional<double> hover;       // pointed at in this frame [s]
  std::optional<double> hover_next;  // what the plots report for the next one [s]
};

struct Series {
  std::span<const float> values;  // one a frame, as in History
  ImU32 color = 0;
  bool steps = false;   // holds its value for a frame
  bool filled = false;  // down to zero
  bool dashed = false;
  float width = 1.5F;
};

/// A level drawn across the plot.
struct Level {
  double value = 0.0;
  std::string name;
  ImU32 color = 0;
};

/// What the vertical axis of one plot remembers: it widens at once and shrinks slowly.
struct PlotRange {
  double low = 0.0;
  double high = 0.0;
  bool set = false;
};

struct PlotSpec {
  const char* id = "";
  std::vector<Series> series;
  std::vector<Level> levels;
  bool logarithmic = false;
  bool from_zero = false;    // the axis starts at 0
  bool counts = false;       // whole numbers: no lines between them
  double least_span = 1.0;   // smallest range shown, in units of the values
  double factor = 1.0;       // value of one unit of the labels
  bool time_labels = false;  // seconds along the bottom
};

/// Draws series over time with one vertical line per pixel column at most, from the least to the
/// greatest value in it: nothing is missed and 200 s cost as much as 2.
void plot(const Look& look, const PlotSpec& spec, const History& history, ImVec2 size,
          TimeAxis& axis, PlotRange& range);

/// The value under the pointer, or the last one. NaN where there is none.
double shown_value(std::span<const float> values, const History& history, const TimeAxis& axis);

}  // namespace substep::ui
