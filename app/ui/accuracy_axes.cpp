#include "app/ui/accuracy_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "app/text/format.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

using Point = Accuracy::Point;

constexpr float kErrorGutter = 38.0F;  // labels of the errors
constexpr float kFootHeight = 38.0F;   // labels of the costs, and the axis title
constexpr float kRail = 20.0F;         // the failed runs
constexpr float kFloorHeight = 18.0F;  // minimum height of the shaded part

LogRange range_of(const std::vector<Point>& a, const std::vector<Point>& b, double RunPoint::*value,
                  double margin) {
  LogRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const std::vector<Point>* list : {&a, &b}) {
    for (const Point& p : *list) {
      if (!(p.*value > 0.0)) continue;
      range.low = std::min(range.low, std::log10(p.*value));
      range.high = std::max(range.high, std::log10(p.*value));
    }
  }
  if (range.low > range.high) return {-1.0, 1.0};
  const double room = std::max(margin * (range.high - range.low), 0.05);
  return {range.low - room, range.high + room};
}

// Widened to hold two labels of powers of ten.
LogRange with_two_decades(LogRange range) {
  if (std::floor(range.high) - std::ceil(range.low) >= 1.0) return range;
  constexpr double kMargin = 0.08;  // so that labels stay clear of the edges
  const double decade = std::floor(range.low + kMargin);
  return {std::min(range.low, decade - kMargin), std::max(range.high, decade + 1.0 + kMargin)};
}

void draw_errors(const Look& look, const AccuracyAxes& axes, ImU32 line, ImDrawList& draw) {
  const int every =
      std::max(1, static_cast<int>(std::ceil((axes.error.high - axes.error.low) * 22.0 /
                                             static_cast<double>(axes.max.y - axes.min.y))));
  for (int e = static_cast<int>(std::ceil(axes.error.low)); e <= static_cast<int>(axes.error.high);
       ++e) {
    const float y = std::round(axes.y(std::pow(10.0, e)));
    if (y < axes.min.y || y > axes.max.y) continue;
    draw.AddLine({axes.min.x, y}, {axes.max.x, y}, line);
    if (e % every != 0) continue;
    const std::string text = power_of_ten(e);
    const ImVec2 size = text_size(look.fonts.small, text);
    draw_text(look.fonts.small, {axes.min.x - size.x - 6.0F, y - 0.5F * size.y}, look.theme->dim,
              text);
  }
}

void draw_costs(const Look& look, const AccuracyAxes& axes, ImU32 line, ImDrawList& draw) {
  float taken = axes.min.x - 20.0F;  // right end of the previous label
  // Powers of ten, if there are two of them; else round values between. One notation on an axis.
  const bool decades = std::floor(axes.cost.high) - std::ceil(axes.cost.low) >= 1.0;
  const bool powers = decades && axes.cost.high >= 5.0;
  for (int e = static_cast<int>(std::floor(axes.cost.low)); e <= static_cast<int>(axes.cost.high);
       ++e) {
    for (const double m : {1.0, 2.0, 5.0}) {
      const double value = m * std::pow(10.0, e);
      const float x = std::round(axes.x(value));
      if (x < axes.min.x || x > axes.max.x) continue;
      draw.AddLine({x, axes.min.y}, {x, axes.max.y}, line);
      if (decades && m != 1.0) continue;
      const std::string text = powers ? power_of_ten(e) : plain_number(value);
      const float width = text_size(look.fonts.small, text).x;
      if (x - 0.5F * width < taken + 6.0F || x + 0.5F * width > axes.max.x + 8.0F) continue;
      draw_text(look.fonts.small, {x - 0.5F * width, axes.max.y + 4.0F}, look.theme->dim, text);
      taken = x + 0.5F * width;
    }
  }
}

}  // namespace

AccuracyAxes accuracy_axes(const Accuracy& accuracy, const std::vector<Point>& points,
                           const std::vector<Point>& failed, ImVec2 origin, ImVec2 size) {
  AccuracyAxes axes{{origin.x + kErrorGutter, origin.y + kRail + 8.0F},
                    {origin.x + size.x - 12.0F, origin.y + size.y - kFootHeight},
                    range_of(points, failed, &RunPoint::cost, 0.04),
                    with_two_decades(range_of(points, {}, &RunPoint::error, 0.05))};
  const double floor = accuracy.floor();
  if (floor > 0.0 && std::log10(floor) > axes.error.low) {
    const double share =
        static_cast<double>(kFloorHeight) / static_cast<double>(axes.max.y - axes.min.y);
    axes.error.low = std::log10(floor) - share * (axes.error.high - std::log10(floor));
  }
  return axes;
}

void draw_accuracy_grid(const Look& look, const Accuracy& accuracy, const AccuracyAxes& axes,
                        ImDrawList& draw) {
  const Theme& t = *look.theme;
  const ImU32 line = fade(t.faint, t.dark ? 0.28F : 0.4F);
  draw_errors(look, axes, line, draw);
  draw_costs(look, axes, line, draw);
  const std::string name =
      fitted(look.fonts.small, axis_name(accuracy.cost), axes.max.x - axes.min.x);
  const float width = text_size(look.fonts.small, name).x;
  draw_text(look.fonts.small, {0.5F * (axes.min.x + axes.max.x - width), axes.max.y + 20.0F}, t.dim,
            name);
}

void draw_floor(const Look& look, const Accuracy& accuracy, const AccuracyAxes& axes,
                ImDrawList& draw) {
  const double floor = accuracy.floor();
  if (!(floor > 0.0) || std::log10(floor) <= axes.error.low) return;
  const Theme& t = *look.theme;
  const float y = axes.y(floor);
  draw.AddRectFilled({axes.min.x, y}, axes.max, fade(t.dim, t.dark ? 0.18F : 0.14F));
  draw.AddLine({axes.min.x, y}, {axes.max.x, y}, fade(t.dim, 0.6F));
  const std::string text = "below " + error_text(floor, accuracy.error) + ": not measured";
  const std::string shown = fitted(look.fonts.small, text, axes.max.x - axes.min.x - 8.0F);
  const float height = text_size(look.fonts.small, shown).y;
  draw_text(look.fonts.small, {axes.min.x + 4.0F, 0.5F * (y + axes.max.y - height)}, t.dim, shown);
}

}  // namespace substep::ui
