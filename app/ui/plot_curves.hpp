#pragma once
// The curves of a plot: selection and drawing of a history's samples.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/ui/plot.hpp"

namespace substep::ui {

/// Maps time and values to the screen.
struct PlotFrame {
  ImVec2 min;
  ImVec2 max;
  double t0 = 0.0;
  double t1 = 1.0;
  double low = 0.0;  // already the logarithm on a logarithmic axis
  double high = 1.0;
  bool logarithmic = false;
  double from = 0.0;  // earlier samples are omitted [s]

  [[nodiscard]] float x(double time) const {
    return min.x + static_cast<float>((time - t0) / (t1 - t0)) * (max.x - min.x);
  }
  [[nodiscard]] double time(float x) const {
    return t0 + (t1 - t0) * static_cast<double>((x - min.x) / (max.x - min.x));
  }
  [[nodiscard]] float y(double value) const {
    const double v = logarithmic ? std::log10(std::max(value, 1e-300)) : value;
    const double share = std::clamp((v - low) / (high - low), -0.02, 1.02);
    return max.y - static_cast<float>(share) * (max.y - min.y);
  }
};

/// The samples within the axis and after the last clear.
History::Slice visible(const History& history, const PlotFrame& f);

/// The extent of samples with an offset added.
Extent shifted(const Extent& extent, double offset);

/// Whether a value can be drawn: finite, and positive on a logarithmic axis.
bool drawable(float value, const PlotFrame& f);

/// Minimum and maximum of one pixel column, or one sample if each has its own column.
struct Column {
  float x = 0.0F;
  float low = 0.0F;  // on screen
  float high = 0.0F;
  float last = 0.0F;
  bool many = false;  // more than one sample
  bool gap = false;   // no line between the previous column and this one
};

/// Removes columns of single samples that do not change the curve: within `room` of the line
/// between the kept ones, or of the previous value if `steps`. @param room [pixel]
std::vector<Column> thinned(const std::vector<Column>& columns, bool steps, float room);

/// Draws one series with at most one vertical line per pixel column.
void draw_series(const Series& series, const PlotFrame& f, ImDrawList& draw);

}  // namespace substep::ui
