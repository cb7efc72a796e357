#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/history.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// The time that all plots show together, and where the pointer is on it.
struct TimeAxis {
  static constexpr double kShortest = 0.1;  // [s]
  static constexpr double kLongest = 600.0;

  double span = 10.0;                // [s]
  bool follow = true;                // the newest stays in view
  double end = 0.0;                  // right edge where it does not follow [s]
  double from = 0.0;                 // what is earlier was cleared [s]
  std::optional<double> hover;       // pointed at in this frame [s]
  std::optional<double> hover_next;  // what the plots report for the next one [s]
  std::optional<double> drag_from;   // a range is being dragged from here [s]
  std::optional<double> clicked;     // to go to; reset by the reader [s]
  std::optional<double> past;        // the moment that the window shows, where it is no longer
                                     // the newest [s]

  /// First and last time shown, for a run that has come to `now` [s].
  [[nodiscard]] std::pair<double, double> window(double now) const;
  /// Shows `factor` times as much; what lies at `fixed` stays there, or the newest when following.
  void zoom(double factor, double fixed, double now);
  /// Shows earlier (< 0) or later. Follows again where there is nothing later.
  void pan(double seconds, double now);
  void show(double t0, double t1);
  void follow_again();
  /// The moment whose values are read: under the pointer, or else the one that the window shows.
  [[nodiscard]] std::optional<double> cursor() const { return hover ? hover : past; }
};

struct Series {
  const History* history = nullptr;
  Channel channel = Channel::kSubsteps;
  ImU32 color = 0;
  std::string name;     // written where the curve ends
  bool steps = false;   // holds its value for a frame
  bool filled = false;  // down to zero
  float width = 1.5F;
  double offset = 0.0;  // added to every sample; on linear axes only
};

/// A level drawn across the plot.
struct Level {
  double value = 0.0;
  std::string name;
  std::string brief;  // where there is little room
  ImU32 color = 0;
};

/// A moment marked on the time axis.
struct Mark {
  double time = 0.0;  // [s]
  std::string name;   // may be empty
  ImU32 color = 0;
};

/// What one plot remembers. Its vertical axis widens at once and shrinks slowly.
struct PlotState {
  double low = 0.0;
  double high = 0.0;
  bool set = false;
  bool logarithmic = false;
  bool shown = true;
};

struct PlotSpec {
  const char* id = "";
  std::vector<Series> series;
  std::vector<Level> levels;
  std::vector<Mark> marks;
  bool from_zero = false;    // a linear axis starts at 0
  bool counts = false;       // whole numbers: no lines between them
  bool linear = false;       // no logarithmic axis: of values that are below 0 or add up
  double most = 0.0;         // a linear axis shows no more to either side of 0; 0: all
  double least_span = 1.0;   // smallest range shown, in units of the values
  double factor = 1.0;       // value of one unit of the labels
  bool time_labels = false;  // seconds along the bottom
};

inline constexpr float kTimeLabelHeight = 18.0F;
inline constexpr float kNameGutter = 56.0F;  // right of the curves, for their names

/// Draws series over time with one vertical line per pixel column at most, from the least to the
/// greatest value in it: nothing is missed and 200 s cost as much as 2. Wheel zooms, a drag shows
/// its range, a drag with the right button or Shift moves, a click goes to its time, a double click
/// follows the newest again.
/// @param size with the gutters of values and names, and with the time labels where there are any
void plot(const Look& look, const PlotSpec& spec, double now, ImVec2 size, TimeAxis& axis,
          PlotState& state);

/// The value at the cursor, or the last one. NaN where there is none.
double shown_value(const History& history, Channel channel, const TimeAxis& axis);

}  // namespace substep::ui
