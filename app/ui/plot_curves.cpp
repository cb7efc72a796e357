#include "app/ui/plot_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace substep::ui {
namespace {

std::vector<Column> samples_of(const Series& series, const History::Slice& slice,
                               const PlotFrame& f) {
  const auto values = (*series.history)[series.channel];
  std::vector<Column> columns;
  columns.reserve(slice.last - slice.first);
  bool gap = false;
  for (std::size_t i = slice.first; i < slice.last; ++i) {
    if (!drawable(values[i], f)) {
      gap = true;
      continue;
    }
    // A stepped series is constant from the start of its frame.
    const double time = series.history->time(i) - (series.steps ? series.history->frame() : 0.0);
    const float y = f.y(static_cast<double>(values[i]) + series.offset);
    columns.push_back({f.x(time), y, y, y, false, gap});
    gap = false;
  }
  return columns;
}

std::vector<Column> decimated(const Series& series, const History::Slice& slice, const PlotFrame& f,
                              float pixel) {
  const History& history = *series.history;
  const Samples& samples = history.samples(series.channel);
  // Columns are fixed in time; otherwise their edges would flicker when the plot scrolls.
  const auto count = static_cast<int>((f.max.x - f.min.x) / pixel);
  const double width = (f.t1 - f.t0) / count;  // [s]
  const double k0 = std::floor(f.t0 / width);
  const auto sample = [&](double time) {  // the first sample at or after a time
    const double i = std::ceil((time - history.time(0)) / history.frame() - 1e-6);
    return static_cast<std::size_t>(
        std::clamp(i, static_cast<double>(slice.first), static_cast<double>(slice.last)));
  };
  std::vector<Column> columns;
  columns.reserve(static_cast<std::size_t>(count) + 2);
  bool gap = false;
  for (int c = 0; c <= count; ++c) {
    const double time = (k0 + c) * width;
    const std::size_t first = sample(time);
    const std::size_t last = sample(time + width);
    if (first >= last) continue;
    const Extent extent = shifted(samples.extent(first, last), series.offset);
    const float low = f.logarithmic ? extent.least_positive : extent.low;
    if (!drawable(low, f)) {
      gap = true;
      continue;
    }
    const auto newest =
        static_cast<float>(static_cast<double>(samples.values()[last - 1]) + series.offset);
    columns.push_back({f.x(time), f.y(static_cast<double>(low)),
                       f.y(static_cast<double>(extent.high)),
                       f.y(static_cast<double>(drawable(newest, f) ? newest : low)), true, gap});
    gap = false;
  }
  return columns;
}

// Below the visible limit [pixel]: a curve that is redrawn every frame must not shimmer.
constexpr float kUnseen = 0.1F;

std::vector<Column> columns_of(const Series& series, const PlotFrame& f) {
  const History::Slice slice = visible(*series.history, f);
  const float pixel = 1.0F / std::max(1.0F, ImGui::GetIO().DisplayFramebufferScale.x);
  const double shown = (f.t1 - f.t0) / series.history->frame();
  const bool many = shown > 3.0 * static_cast<double>((f.max.x - f.min.x) / pixel);
  if (many) return decimated(series, slice, f, pixel);
  return thinned(samples_of(series, slice, f), series.steps, kUnseen * pixel);
}

// Filled down to zero, slice by slice. Antialiased edges between slices would show as stripes.
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

/// Range of slopes for a line from one sample that passes the next ones within `room`.
struct Cone {
  Column tip;
  float least = -std::numeric_limits<float>::infinity();  // slopes
  float greatest = std::numeric_limits<float>::infinity();

  [[nodiscard]] bool reaches(const Column& c) const {
    const float slope = (c.last - tip.last) / (c.x - tip.x);
    return slope >= least && slope <= greatest;
  }
  void narrow(const Column& c, float room) {
    least = std::max(least, (c.last - room - tip.last) / (c.x - tip.x));
    greatest = std::min(greatest, (c.last + room - tip.last) / (c.x - tip.x));
  }
};

}  // namespace

std::vector<Column> thinned(const std::vector<Column>& columns, bool steps, float room) {
  std::vector<Column> kept;
  Cone cone;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& c = columns[i];
    const bool last = i + 1 == columns.size() || columns[i + 1].gap;
    if (kept.empty() || c.gap) {
      kept.push_back(c);
      cone = {c};
      continue;
    }
    if (steps) {
      if (c.last != kept.back().last) kept.push_back(c);
      continue;
    }
    if (!cone.reaches(c)) {
      kept.push_back(columns[i - 1]);
      cone = {columns[i - 1]};
    }
    cone.narrow(c, room);
    if (last) kept.push_back(c);
  }
  return kept;
}

History::Slice visible(const History& history, const PlotFrame& f) {
  History::Slice slice = history.between(f.t0, f.t1);
  if (f.from > history.start_time()) {
    slice.first = std::max(slice.first, history.between(f.from + history.frame(), f.t1).first);
  }
  slice.last = std::max(slice.first, slice.last);
  return slice;
}

Extent shifted(const Extent& extent, double offset) {
  if (offset == 0.0 || extent.empty()) return extent;
  Extent moved;
  moved.add(static_cast<float>(static_cast<double>(extent.low) + offset));
  moved.add(static_cast<float>(static_cast<double>(extent.high) + offset));
  return moved;
}

bool drawable(float value, const PlotFrame& f) {
  return std::isfinite(value) && !(f.logarithmic && value <= 0.0F);
}

void draw_series(const Series& series, const PlotFrame& f, ImDrawList& draw) {
  const std::vector<Column> columns = columns_of(series, f);
  if (columns.empty()) return;
  const float end = f.x(series.history->end_time());  // end of a stepped series
  if (series.filled && !f.logarithmic) {
    fill_series(series, columns, std::clamp(f.y(0.0), f.min.y, f.max.y), end, draw);
  }
  std::vector<ImVec2> points;
  points.reserve(3 * columns.size() + 1);
  const auto flush = [&] {
    draw.AddPolyline(points.data(), static_cast<int>(points.size()), series.color, 0, series.width);
    points.clear();
  };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& c = columns[i];
    if (c.gap) flush();
    if (series.steps && !points.empty()) points.emplace_back(c.x, columns[i - 1].last);
    if (c.many) {  // down and up, ending at the last value
      points.emplace_back(c.x, c.low);
      points.emplace_back(c.x, c.high);
    }
    points.emplace_back(c.x, c.last);
  }
  if (series.steps) points.emplace_back(end, columns.back().last);
  const ImVec2 newest = points.back();
  flush();
  if (!series.steps) draw.AddCircleFilled(newest, 2.5F, series.color);
}

}  // namespace substep::ui
