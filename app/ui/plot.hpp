#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/history.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// The time axis shared by all plots, and the pointer's position on it.
struct TimeAxis {
  static constexpr double kShortest = 0.1;  // [s]
  static constexpr double kLongest = 600.0;

  double span = 10.0;                // [s]
  bool follow = true;                // keeps the newest sample in view
  double end = 0.0;                  // right edge if it does not follow [s]
  double from = 0.0;                 // earlier samples are hidden [s]
  std::optional<double> hover;       // under the pointer in this frame [s]
  std::optional<double> hover_next;  // reported by the plots, for the next frame [s]
  std::optional<double> drag_from;   // start of a range being dragged [s]
  std::optional<double> clicked;     // time to go to; reset by the reader [s]
  std::optional<double> past;        // time shown, if it is not the newest [s]

  /// First and last time shown for a run at time `now` [s].
  [[nodiscard]] std::pair<double, double> window(double now) const;
  /// Scales the span by `factor`; keeps `fixed` in place, or the newest sample when following.
  void zoom(double factor, double fixed, double now);
  /// Shifts to earlier (< 0) or later times. Follows again at the newest sample.
  void pan(double seconds, double now);
  void show(double t0, double t1);
  void follow_again();
  /// The time at which values are read: under the pointer, or else the displayed past moment.
  [[nodiscard]] std::optional<double> cursor() const { return hover ? hover : past; }
};

struct Series {
  const History* history = nullptr;
  Channel channel = Channel::kSubsteps;
  ImU32 color = 0;
  std::string name;     // label at the end of the curve
  bool steps = false;   // constant within a frame
  bool filled = false;  // down to zero
  float width = 1.5F;
  double offset = 0.0;  // added to every sample; on linear axes only
};

/// A horizontal line across the plot.
struct Level {
  double value = 0.0;
  std::string name;
  std::string brief;  // short name, for narrow plots
  ImU32 color = 0;
};

/// A moment marked on the time axis.
struct Mark {
  double time = 0.0;  // [s]
  std::string name;   // may be empty
  ImU32 color = 0;
};

/// State of one plot. Its vertical axis expands at once and shrinks slowly.
struct PlotState {
  double low = 0.0;
  double high = 0.0;
  bool set = false;
  bool logarithmic = false;
  bool shown = true;
};

struct PlotSpec {
  const char* id = "";
  std::vector<Series> series{};
  std::vector<Level> levels{};
  std::vector<Mark> marks{};
  bool counts = false;       // integers: no grid lines between them
  bool linear = false;       // no logarithmic axis: values can be negative or are sums
  double most = 0.0;         // limit of a linear axis on either side of 0; 0: none
  double least_span = 1.0;   // smallest range shown, in units of the values
  double factor = 1.0;       // value of one unit of the labels
  bool time_labels = false;  // seconds along the bottom
};

inline constexpr float kTimeLabelHeight = 18.0F;
inline constexpr float kNameGutter = 56.0F;  // for the names, right of the curves

/// Draws series over time with at most one vertical line per pixel column, from minimum to maximum:
/// no sample is missed, and 200 s cost as much as 2 s. Wheel zooms, drag selects a range, right
/// drag or Shift+drag pans, click goes to its time, double click follows the newest again.
/// @param size including the gutters of values and names, and the time labels if shown
void plot(const Look& look, const PlotSpec& spec, double now, ImVec2 size, TimeAxis& axis,
          PlotState& state);

/// The value at the cursor, or the last one. NaN if there is none.
double shown_value(const History& history, Channel channel, const TimeAxis& axis);

}  // namespace substep::ui
