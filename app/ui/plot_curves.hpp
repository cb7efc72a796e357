#pragma once
// The curves of a plot: which of a history's samples are drawn, and how.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/ui/plot.hpp"

namespace substep::ui {

/// Where time and values lie on the screen.
struct PlotFrame {
  ImVec2 min;
  ImVec2 max;
  double t0 = 0.0;
  double t1 = 1.0;
  double low = 0.0;  // already the logarithm on a logarithmic axis
  double high = 1.0;
  bool logarithmic = false;

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

/// What of a history is shown: within the axis, and not cleared. @param from what is earlier was
/// [s]
History::Slice visible(const History& history, const PlotFrame& f, double from);

/// The extent of samples to each of which an offset is added.
Extent shifted(const Extent& extent, double offset);

/// Whether a value has a place on the axis: it is finite, and positive on a logarithmic one.
bool drawable(float value, const PlotFrame& f);

/// Least and greatest value of one pixel column, or one sample where there is room for each.
struct Column {
  float x = 0.0F;
  float low = 0.0F;  // on the screen
  float high = 0.0F;
  float last = 0.0F;
  bool many = false;  // more than one sample
  bool gap = false;   // nothing to draw between the one before and this one
};

/// Those of single samples without which the curve is the same: within `room` of the line between
/// the ones kept, or of the value before where it is `steps`. @param room [pixel]
std::vector<Column> thinned(const std::vector<Column>& columns, bool steps, float room);

/// One series, at most one vertical line per pixel column. @param from what is earlier is left out
void draw_series(const Series& series, double from, const PlotFrame& f, ImDrawList& draw);

}  // namespace substep::ui
