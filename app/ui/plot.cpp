#include "app/ui/plot.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/format.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// The samples that a stretch of time holds, as [first, last).
struct Slice {
  std::size_t first = 0;
  std::size_t last = 0;
};

// Where time and values lie on the screen.
struct Frame {
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
  [[nodiscard]] float y(double value) const {
    const double v = logarithmic ? std::log10(std::max(value, 1e-300)) : value;
    const double share = std::clamp((v - low) / (high - low), -0.02, 1.02);
    return max.y - static_cast<float>(share) * (max.y - min.y);
  }
};

Slice visible(const History& history, double t0, double t1) {
  const auto count = static_cast<double>(history.size());
  if (history.size() == 0) return {};
  const double first = std::floor((t0 - history.time(0)) / history.frame());
  const double last = std::ceil((t1 - history.time(0)) / history.frame()) + 1.0;
  return {static_cast<std::size_t>(std::clamp(first, 0.0, count)),
          static_cast<std::size_t>(std::clamp(last, 0.0, count))};
}

// 1, 2 or 5 times a power of ten, so that about `count` fit into the range.
double nice_step(double range, int count) {
  const double rough = range / std::max(1, count);
  const double power = std::pow(10.0, std::floor(std::log10(std::max(rough, 1e-300))));
  for (const double m : {1.0, 2.0, 5.0}) {
    if (m * power >= rough) return m * power;
  }
  return 10.0 * power;
}

void find_range(const PlotSpec& spec, const Slice& slice, PlotRange& range) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto include = [&](double v) {
    if (!std::isfinite(v) || (spec.logarithmic && v <= 0.0)) return;
    if (spec.logarithmic) v = std::log10(v);
    low = std::min(low, v);
    high = std::max(high, v);
  };
  for (const Series& series : spec.series) {
    for (std::size_t i = slice.first; i < std::min(slice.last, series.values.size()); ++i) {
      include(static_cast<double>(series.values[i]));
    }
  }
  for (const Level& level : spec.levels) include(level.value);
  if (spec.from_zero) include(0.0);
  if (!(low <= high)) {
    low = spec.logarithmic ? -9.0 : 0.0;
    high = spec.logarithmic ? -3.0 : spec.least_span;
  }
  if (spec.logarithmic) {
    low = std::floor(low + 0.02);
    high = std::max(std::ceil(high - 0.02), low + 2.0);
  } else {
    const double span = std::max(high - low, spec.least_span);
    if (!spec.from_zero || low < 0.0) low -= 0.06 * span;
    high = std::max(high, low + span) + 0.1 * span;
  }
  if (!range.set) {
    range = {low, high, true};
    return;
  }
  const auto settle = [](double& now, double goal, bool wider) {
    now += (wider ? 1.0 : 0.04) * (goal - now);
    if (std::abs(now - goal) < 1e-3 * std::abs(goal)) now = goal;
  };
  settle(range.low, low, low < range.low);
  settle(range.high, high, high > range.high);
}

// Lines at round values, or the words for them: the words go over the series.
void draw_grid(const Look& look, const PlotSpec& spec, const Frame& f, ImDrawList& draw,
               bool words) {
  const ImU32 line = fade(look.theme->faint, look.theme->dark ? 0.28F : 0.4F);
  const double lines = static_cast<double>(f.max.y - f.min.y) / 32.0;
  double step = f.logarithmic ? std::max(1.0, std::ceil((f.high - f.low) / std::max(lines, 2.0)))
                              : spec.factor * nice_step((f.high - f.low) / spec.factor,
                                                        static_cast<int>(std::max(lines, 2.0)));
  if (spec.counts) step = std::max(step, 1.0);
  const double first = std::ceil(f.low / step - 1e-9) * step;
  const int digits =
      std::clamp(static_cast<int>(-std::floor(std::log10(step / spec.factor) + 1e-9)), 0, 6);
  float above = f.max.y + 15.0F;  // top of the words below
  for (int i = 0; i < 12; ++i) {
    const double v = first + i * step;
    if (v > f.high) break;
    const float y = std::round(f.max.y - static_cast<float>((v - f.low) / (f.high - f.low)) *
                                             (f.max.y - f.min.y));
    if (!words) {
      draw.AddLine({f.min.x, y}, {f.max.x, y}, line);
      continue;
    }
    const std::string text = f.logarithmic ? power_of_ten(static_cast<int>(std::lround(v)))
                             : std::abs(v) >= 1e5 * spec.factor ? short_number(v / spec.factor)
                                                                : fixed(v / spec.factor, digits);
    const float top = y - 15.0F < f.min.y ? y + 1.0F : y - 15.0F;
    if (y > f.max.y - 2.0F || y < f.min.y || top + 13.0F > above) continue;
    above = top;
    for (const float dx : {-1.0F, 0.0F, 1.0F}) {
      for (const float dy : {-1.0F, 1.0F}) {
        draw_text(draw, look.fonts.small, {f.min.x + 6.0F + dx, top + dy},
                  fade(look.theme->well, 0.8F), text.c_str());
      }
    }
    draw_text(draw, look.fonts.small, {f.min.x + 6.0F, top}, look.theme->dim, text.c_str());
  }
}

void draw_time(const Look& look, const PlotSpec& spec, const Frame& f, ImDrawList& draw) {
  const ImU32 line = fade(look.theme->faint, look.theme->dark ? 0.16F : 0.25F);
  const double step = nice_step(f.t1 - f.t0, static_cast<int>((f.max.x - f.min.x) / 44.0F));
  const int digits = step < 0.1 ? 2 : step < 1.0 ? 1 : 0;
  const double first = std::ceil(f.t0 / step) * step;
  for (int i = 0; first + i * step <= f.t1; ++i) {
    const double t = first + i * step;
    const float x = std::round(f.x(t));
    draw.AddLine({x, f.min.y}, {x, f.max.y}, line);
    if (!spec.time_labels || t < 0.5 * step) continue;
    const std::string text = fixed(t, digits) + " s";
    const ImVec2 size = text_size(look.fonts.small, text.c_str());
    if (x + 0.5F * size.x > f.max.x || x - 0.5F * size.x < f.min.x) continue;
    draw_text(draw, look.fonts.small, {x - 0.5F * size.x, f.max.y + 3.0F}, look.theme->dim,
              text.c_str());
  }
}

// Least and greatest value of one pixel column, or one sample where there is room for each.
struct Column {
  float x = 0.0F;
  float low = 0.0F;  // on the screen
  float high = 0.0F;
  float last = 0.0F;
  int samples = 1;
  bool gap = false;  // nothing to draw between the one before and this one
};

std::vector<Column> columns_of(const Series& series, const Slice& slice, const History& history,
                               const Frame& f) {
  std::vector<Column> columns;
  bool gap = false;
  const float pixel = 1.0F / std::max(1.0F, ImGui::GetIO().DisplayFramebufferScale.x);
  const double samples = (f.t1 - f.t0) / history.frame();
  const float width =
      samples > 4.0 * static_cast<double>((f.max.x - f.min.x) / pixel) ? pixel : 0.0F;
  for (std::size_t i = slice.first; i < std::min(slice.last, series.values.size()); ++i) {
    const auto value = static_cast<double>(series.values[i]);
    if (!std::isfinite(value) || (f.logarithmic && value <= 0.0)) {
      gap = true;
      continue;
    }
    // A stepped series holds from the start of its frame.
    const double time = history.time(i) - (series.steps ? history.frame() : 0.0);
    const float x = f.x(time);
    const float y = f.y(value);
    if (!gap && !columns.empty() && x < columns.back().x + width) {
      Column& c = columns.back();
      c.low = std::min(c.low, y);
      c.high = std::max(c.high, y);
      c.last = y;
      ++c.samples;
    } else {
      columns.push_back({x, y, y, y, 1, gap});
      gap = false;
    }
  }
  return columns;
}

void draw_dashed(ImDrawList& draw, ImVec2 a, ImVec2 b, ImU32 color, float width) {
  constexpr float kOn = 5.0F;
  constexpr float kOff = 4.0F;
  const int count = static_cast<int>((b.x - a.x) / (kOn + kOff)) + 1;
  for (int i = 0; i < count; ++i) {
    const float x = a.x + static_cast<float>(i) * (kOn + kOff);
    draw.AddLine({x, a.y}, {std::min(x + kOn, b.x), b.y}, color, width);
  }
}

// Dashes by distance along the line, whatever its points are.
void draw_dashes(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 color, float width) {
  constexpr float kOn = 4.0F;
  constexpr float kPeriod = 7.0F;
  float along = 0.0F;  // where in the period the segment starts
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const ImVec2 a = points[i];
    const ImVec2 d(points[i + 1].x - a.x, points[i + 1].y - a.y);
    const float length = std::hypot(d.x, d.y);
    float at = 0.0F;
    while (at < length) {
      const bool on = along < kOn;
      const float to = std::min(length, at + (on ? kOn : kPeriod) - along);
      if (on) {
        draw.AddLine({a.x + d.x * at / length, a.y + d.y * at / length},
                     {a.x + d.x * to / length, a.y + d.y * to / length}, color, width);
      }
      along += to - at + 1e-4F;
      if (along >= kPeriod) along = 0.0F;
      at = to + 1e-4F;
    }
  }
}

void draw_line(const Series& series, std::vector<ImVec2>& points, ImDrawList& draw) {
  if (series.dashed) {
    draw_dashes(draw, points, series.color, series.width);
  } else {
    draw.AddPolyline(points.data(), static_cast<int>(points.size()), series.color, 0, series.width);
  }
  points.clear();
}

// Down to zero, slice by slice. Soft edges between the slices would show as stripes.
void fill_series(const Series& series, const std::vector<Column>& columns, float zero, float end,
                 ImDrawList& draw) {
  const ImDrawListFlags flags = draw.Flags;
  draw.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& c = columns[i];
    const bool more = i + 1 < columns.size();
    const float right = more ? columns[i + 1].x : series.steps ? end : c.x;
    const float right_y = more && !series.steps ? columns[i + 1].last : c.last;
    draw.AddQuadFilled({c.x, c.last}, {right, right_y}, {right, zero}, {c.x, zero},
                       fade(series.color, 0.14F));
  }
  draw.Flags = flags;
}

void draw_series(const Series& series, const Slice& slice, const History& history, const Frame& f,
                 ImDrawList& draw) {
  const std::vector<Column> columns = columns_of(series, slice, history, f);
  if (columns.empty()) return;
  const float end = f.x(history.end_time());  // a stepped series holds until here
  if (series.filled) {
    fill_series(series, columns, std::clamp(f.y(0.0), f.min.y, f.max.y), end, draw);
  }
  std::vector<ImVec2> points;
  points.reserve(3 * columns.size() + 1);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& c = columns[i];
    if (c.gap) draw_line(series, points, draw);
    if (series.steps && !points.empty()) points.emplace_back(c.x, columns[i - 1].last);
    if (c.samples > 1) {  // many samples in the column: down and up, ending at the last
      points.emplace_back(c.x, c.low);
      points.emplace_back(c.x, c.high);
    }
    points.emplace_back(c.x, c.last);
  }
  if (series.steps) points.emplace_back(end, columns.back().last);
  const ImVec2 newest = points.back();
  draw_line(series, points, draw);
  if (!series.steps && !series.dashed) draw.AddCircleFilled(newest, 2.5F, series.color);
}

}  // namespace

double shown_value(std::span<const float> values, const History& history, const TimeAxis& axis) {
  if (values.empty()) return kNothing;
  if (!axis.hover) return static_cast<double>(values.back());
  const double i = std::round((*axis.hover - history.time(0)) / history.frame());
  if (i < 0.0 || i >= static_cast<double>(values.size())) return kNothing;
  return static_cast<double>(values[static_cast<std::size_t>(i)]);
}

void plot(const Look& look, const PlotSpec& spec, const History& history, ImVec2 size,
          TimeAxis& axis, PlotRange& range) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float below = spec.time_labels ? 18.0F : 0.0F;
  ImGui::InvisibleButton(spec.id, size);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();

  // What is newest stands at the right edge once there is more than fits.
  Frame f;
  f.min = origin;
  f.max = {origin.x + size.x, origin.y + size.y - below};
  f.t1 = std::max(axis.span, history.end_time());
  f.t0 = f.t1 - axis.span;
  f.logarithmic = spec.logarithmic;
  const Slice slice = visible(history, f.t0, f.t1);
  find_range(spec, slice, range);
  f.low = range.low;
  f.high = range.high;

  draw.AddRectFilled(f.min, f.max, look.theme->well, 4.0F);
  draw_time(look, spec, f, draw);
  draw.PushClipRect(f.min, f.max, true);
  draw_grid(look, spec, f, draw, false);
  for (const Series& series : spec.series) draw_series(series, slice, history, f, draw);
  draw_grid(look, spec, f, draw, true);
  for (const Level& level : spec.levels) {
    const float y = std::round(f.y(level.value)) + 0.5F;
    draw_dashed(draw, {f.min.x, y}, {f.max.x, y}, level.color, 1.0F);
    const ImVec2 text = text_size(look.fonts.small, level.name.c_str());
    const float text_y = y - text.y - 1.0F < f.min.y ? y + 2.0F : y - text.y - 1.0F;
    draw_text(draw, look.fonts.small, {f.max.x - text.x - 6.0F, text_y}, level.color,
              level.name.c_str());
  }
  if (axis.hover && *axis.hover >= f.t0 && *axis.hover <= f.t1) {
    const float x = std::round(f.x(*axis.hover)) + 0.5F;
    draw.AddLine({x, f.min.y}, {x, f.max.y}, fade(look.theme->text, 0.5F));
    for (const Series& series : spec.series) {
      const double value = shown_value(series.values, history, axis);
      if (std::isfinite(value) && !(f.logarithmic && value <= 0.0)) {
        draw.AddCircleFilled({x, f.y(value)}, 3.0F, series.color);
      }
    }
  }
  draw.PopClipRect();

  if (hovered) {
    const ImGuiIO& io = ImGui::GetIO();
    const double t =
        f.t0 + (f.t1 - f.t0) * static_cast<double>((io.MousePos.x - f.min.x) / (f.max.x - f.min.x));
    axis.hover_next = t;
    if (io.MouseWheel != 0.0F) {
      axis.span =
          std::clamp(axis.span * std::pow(0.85, static_cast<double>(io.MouseWheel)), 1.0, 600.0);
    }
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
  }
}

}  // namespace substep::ui
