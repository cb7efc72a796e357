#include "app/ui/plot.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "app/text/format.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/plot_curves.hpp"
#include "app/ui/plot_labels.hpp"
#include "app/ui/timing.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kGutter = 40.0F;  // left of the curves, for the value labels
constexpr float kToggle = 16.0F;  // height of "log" at the top, shown while the plot is hovered

// 1, 2 or 5 times a power of ten, such that about `count` fit into the range.
double nice_step(double range, int count) {
  const double rough = range / std::max(1, count);
  const double power = std::pow(10.0, std::floor(std::log10(std::max(rough, 1e-300))));
  for (const double m : {1.0, 2.0, 5.0}) {
    if (m * power >= rough) return m * power;
  }
  return 10.0 * power;
}

// Number of multiples of a step in a range.
int multiples(double low, double high, double step) {
  return static_cast<int>(std::floor(high / step) - std::ceil(low / step)) + 1;
}

struct Range {
  double low = 0.0;
  double high = 1.0;
};

// Includes zero.
Range linear_range(const PlotSpec& spec, const Extent& all) {
  double low = all.empty() ? 0.0 : std::min(static_cast<double>(all.low), 0.0);
  double high = all.empty() ? spec.least_span : std::max(static_cast<double>(all.high), 0.0);
  if (spec.most > 0.0) {
    low = std::max(low, -spec.most);
    high = std::min(high, spec.most);
  }
  // A level is included unless it is so high that the curves would be flat.
  for (const Level& level : spec.levels) {
    if (level.value < 3.0 * std::max(high, spec.least_span)) high = std::max(high, level.value);
  }
  const double span = std::max(high - low, spec.least_span);
  if (low < 0.0) low -= 0.06 * span;
  return {low, std::max(high, low + span) + 0.1 * span};
}

// Whole decades, at least two.
Range logarithmic_range(const Extent& all) {
  if (!(all.high > 0.0F)) return {-9.0, -3.0};
  const double low = std::floor(std::log10(static_cast<double>(all.least_positive)) + 0.02);
  const double high = std::ceil(std::log10(static_cast<double>(all.high)) - 0.02);
  return {low, std::max(high, low + 2.0)};
}

void find_range(const PlotSpec& spec, const PlotFrame& f, PlotState& state) {
  Extent all;
  for (const Series& series : spec.series) {
    const History::Slice slice = visible(*series.history, f);
    all.add(shifted(series.history->samples(series.channel).extent(slice.first, slice.last),
                    series.offset));
  }
  const Range goal = f.logarithmic ? logarithmic_range(all) : linear_range(spec, all);
  if (!state.set) {
    state.low = goal.low;
    state.high = goal.high;
    state.set = true;
    return;
  }
  const double span = goal.high - goal.low;
  const auto settle = [span](double& now, double wanted, bool wider) {
    now += (wider ? 1.0 : 0.04) * (wanted - now);
    if (std::abs(now - wanted) < 1e-3 * span) now = wanted;
  };
  settle(state.low, goal.low, goal.low < state.low);
  settle(state.high, goal.high, goal.high > state.high);
}

std::string label_of(const PlotSpec& spec, const PlotFrame& f, double v, int digits) {
  if (f.logarithmic) return power_of_ten(static_cast<int>(std::lround(v)));
  if (std::abs(v) >= 1e4 * spec.factor || digits > 4) return coarse_number(v / spec.factor);
  return fixed(v / spec.factor, digits);
}

// Grid lines at round values, with labels in the gutter.
/// @param taken occupied height at the gutter's top
void draw_values(const Look& look, const PlotSpec& spec, const PlotFrame& f, float taken,
                 ImDrawList& draw) {
  const ImU32 line = fade(look.theme->faint, look.theme->dark ? 0.28F : 0.4F);
  const double lines = static_cast<double>(f.max.y - f.min.y) / 32.0;
  double step = f.logarithmic ? std::max(1.0, std::ceil((f.high - f.low) / std::max(lines, 2.0)))
                              : spec.factor * nice_step((f.high - f.low) / spec.factor,
                                                        static_cast<int>(std::max(lines, 2.0)));
  // One line does not define the scale: low plots have closer lines.
  while (!f.logarithmic && multiples(f.low, f.high, step) < 2) {
    step = spec.factor * nice_step(0.39 * step / spec.factor, 1);
  }
  if (spec.counts && !f.logarithmic) step = std::max(step, 1.0);
  const double first = std::ceil(f.low / step - 1e-9) * step;
  const int digits =
      std::clamp(static_cast<int>(-std::floor(std::log10(step / spec.factor) + 1e-9)), 0, 6);
  float above = f.max.y + 15.0F;  // top of the previous label
  for (int i = 0; i < 12; ++i) {
    const double v = first + i * step;
    if (v > f.high) break;
    const float y = std::round(f.max.y - static_cast<float>((v - f.low) / (f.high - f.low)) *
                                             (f.max.y - f.min.y));
    draw.AddLine({f.min.x, y}, {f.max.x, y}, line);
    const std::string text = label_of(spec, f, v, digits);
    const ImVec2 size = text_size(look.fonts.small, text);
    const float top = std::clamp(y - 0.5F * size.y, f.min.y - 2.0F, f.max.y - size.y + 2.0F);
    if (top < f.min.y + taken - 3.0F || top + size.y > above) continue;
    above = top;
    draw_text(look.fonts.small, {f.min.x - 6.0F - size.x, top}, look.theme->dim, text);
  }
}

// @param cursor takes the place of the labels beneath it
void draw_time(const Look& look, const PlotSpec& spec, const PlotFrame& f,
               const std::optional<TimeLabel>& cursor, ImDrawList& draw) {
  const ImU32 line = fade(look.theme->faint, look.theme->dark ? 0.16F : 0.25F);
  const double step = nice_step(f.t1 - f.t0, static_cast<int>((f.max.x - f.min.x) / 50.0F));
  const int digits = step < 0.1 ? 2 : step < 1.0 ? 1 : 0;
  const double first = std::ceil(f.t0 / step) * step;
  float before = f.min.x - 8.0F;  // right end of the previous label
  for (int i = 0; first + i * step <= f.t1; ++i) {
    const double t = first + i * step;
    const float x = std::round(f.x(t));
    draw.AddLine({x, f.min.y}, {x, f.max.y}, line);
    if (!spec.time_labels) continue;
    const std::string text = fixed(t, digits) + " s";
    const ImVec2 size = text_size(look.fonts.small, text);
    const float left = std::clamp(x - 0.5F * size.x, f.min.x, f.max.x - size.x);
    if (left < before + 8.0F) continue;
    if (cursor && left + size.x + 8.0F > cursor->left &&
        left < cursor->left + cursor->size.x + 8.0F) {
      continue;
    }
    before = left + size.x;
    draw_text(look.fonts.small, {left, f.max.y + 3.0F}, look.theme->dim, text);
  }
}

void draw_cursor(const Look& look, const PlotSpec& spec, const PlotFrame& f, const TimeAxis& axis,
                 ImDrawList& draw) {
  const std::optional<double> cursor = axis.cursor();
  if (!cursor || *cursor < f.t0 || *cursor > f.t1) return;
  const float x = std::round(f.x(*cursor)) + 0.5F;
  if (axis.drag_from) {
    draw.AddRectFilled({f.x(*axis.drag_from), f.min.y}, {x, f.max.y},
                       fade(look.theme->accent, 0.25F));
  }
  draw.AddLine({x, f.min.y}, {x, f.max.y}, fade(look.theme->text, 0.5F));
  for (const Series& series : spec.series) {
    const double value = shown_value(*series.history, series.channel, axis) + series.offset;
    if (drawable(static_cast<float>(value), f)) {
      draw.AddCircleFilled({x, f.y(value)}, 3.0F, series.color);
    }
  }
}

void interact(const PlotFrame& f, double now, TimeAxis& axis) {
  const ImGuiIO& io = ImGui::GetIO();
  const double t = f.time(io.MousePos.x);
  const bool moved = ImGui::IsMouseDragPastThreshold(ImGuiMouseButton_Left, 4.0F);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    axis.hover_next = std::clamp(t, f.t0, f.t1);
  }
  if (ImGui::IsItemHovered()) {
    if (io.MouseWheel != 0.0F)
      axis.zoom(std::pow(0.85, static_cast<double>(io.MouseWheel)), t, now);
    if (io.MouseWheelH != 0.0F) {
      axis.pan(-0.05 * axis.span * static_cast<double>(io.MouseWheelH), now);
    }
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelX);
  }
  const bool moves = io.KeyShift || ImGui::IsMouseDown(ImGuiMouseButton_Right) ||
                     ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  const bool pressed = ImGui::IsItemActivated();  // the motion of this frame precedes it
  if (pressed && !moves) axis.drag_from = t;
  if (ImGui::IsItemActive() && !pressed && moves && io.MouseDelta.x != 0.0F) {
    axis.drag_from.reset();
    axis.pan(static_cast<double>(-io.MouseDelta.x / (f.max.x - f.min.x)) * axis.span, now);
  }
  if (ImGui::IsItemDeactivated()) {
    if (axis.drag_from && moved) {
      axis.show(std::clamp(*axis.drag_from, f.t0, f.t1), std::clamp(t, f.t0, f.t1));
    } else if (axis.drag_from) {
      axis.clicked = std::clamp(t, axis.from, now);
    }
    axis.drag_from.reset();
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    axis.drag_from.reset();
    axis.clicked = now;  // the first of the two clicks had gone back
    axis.follow_again();
  }
}

/// @param pointed whether the plot is hovered @return whether it is visible
bool scale_toggle(const Look& look, ImVec2 at, bool pointed, PlotState& state) {
  ImGui::SetCursorScreenPos(at);
  if (ImGui::InvisibleButton("scale", {kGutter - 4.0F, kToggle})) {
    state.logarithmic = !state.logarithmic;
    state.set = false;
  }
  const char* name = state.logarithmic ? "log" : "lin";
  const bool seen = pointed || ImGui::IsItemFocused();
  if (!seen) return false;
  draw_text_before(look.fonts.small, {at.x + kGutter - 6.0F, at.y},
                   ImGui::IsItemHovered() ? look.theme->accent_hover : look.theme->dim, name);
  draw_focus(look);
  tooltip(look, "",
          state.logarithmic ? "Logarithmic scale: click for linear"
                            : "Linear scale: click for logarithmic");
  return true;
}

}  // namespace

double shown_value(const History& history, Channel channel, const TimeAxis& axis) {
  if (const auto cursor = axis.cursor()) return history.at(channel, *cursor);
  const auto values = history[channel];
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : static_cast<double>(values.back());
}

void plot(const Look& look, const PlotSpec& spec, double now, ImVec2 size, TimeAxis& axis,
          PlotState& state) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float below = spec.time_labels ? kTimeLabelHeight : 0.0F;
  ImDrawList& draw = *ImGui::GetWindowDrawList();

  PlotFrame f;
  f.min = {origin.x + kGutter, origin.y};
  f.max = {origin.x + size.x - kNameGutter, origin.y + size.y - below};
  std::tie(f.t0, f.t1) = axis.window(now);
  f.logarithmic = state.logarithmic && !spec.linear;
  f.from = axis.from;
  find_range(spec, f, state);
  f.low = state.low;
  f.high = state.high;

  ImGui::PushID(spec.id);
  const bool pointed = ImGui::IsMouseHoveringRect(origin, f.max);
  const bool toggle = !spec.linear && scale_toggle(look, origin, pointed, state);
  draw.AddRectFilled(f.min, f.max, look.theme->well, 4.0F);
  const auto cursor = spec.time_labels ? cursor_time(look, f, axis) : std::nullopt;
  draw_time(look, spec, f, cursor, draw);
  draw_values(look, spec, f, toggle ? kToggle : 0.0F, draw);
  draw.PushClipRect(f.min, f.max, true);
  for (const Series& series : spec.series) draw_series(series, f, draw);
  draw_cursor(look, spec, f, axis, draw);
  draw_marks(look, spec, f, draw);
  draw.PopClipRect();
  draw_levels(look, spec, f, draw);
  draw_names(look, spec, f, draw);
  if (cursor) draw_cursor_time(look, f, *cursor, draw);

  mark(spec.id, {origin.x, origin.y - kHeading}, {origin.x + size.x, origin.y + size.y}, "plot");
  ImGui::SetCursorScreenPos(f.min);
  ImGui::InvisibleButton("curves", {f.max.x - f.min.x, f.max.y - f.min.y},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  interact(f, now, axis);
  ImGui::PopID();
  ImGui::SetCursorScreenPos(origin);
  ImGui::Dummy(size);
}

}  // namespace substep::ui
