#include "app/ui/accuracy_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kErrorGutter = 38.0F;  // labels of the errors
constexpr float kFootHeight = 38.0F;   // labels of the costs, and what they are
constexpr float kRail = 20.0F;         // the failed runs
constexpr float kReach = 14.0F;        // a point is pointed at from so far

using Point = Accuracy::Point;

struct LogRange {  // of logarithms
  double low = 0.0;
  double high = 1.0;
};

/// Where costs and errors lie on the screen.
struct Axes {
  ImVec2 min;
  ImVec2 max;
  LogRange cost;
  LogRange error;

  [[nodiscard]] float x(double value) const {
    return min.x + static_cast<float>((std::log10(value) - cost.low) / (cost.high - cost.low)) *
                       (max.x - min.x);
  }
  [[nodiscard]] float y(double value) const {
    return max.y - static_cast<float>((std::log10(value) - error.low) / (error.high - error.low)) *
                       (max.y - min.y);
  }
  [[nodiscard]] ImVec2 at(const Point& p) const { return {x(p.cost), y(p.error)}; }
  /// On the rail above the picture; PGS a little higher, so that both solvers can be seen.
  [[nodiscard]] ImVec2 on_rail(const Point& p, bool higher) const {
    return {x(p.cost), min.y - (higher ? 15.0F : 6.0F)};
  }
};

template <class Value>
LogRange range_of(const std::vector<Point>& a, const std::vector<Point>& b, Value value,
                  double margin) {
  LogRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const std::vector<Point>* list : {&a, &b}) {
    for (const Point& p : *list) {
      if (!(value(p) > 0.0)) continue;
      range.low = std::min(range.low, std::log10(value(p)));
      range.high = std::max(range.high, std::log10(value(p)));
    }
  }
  if (range.low > range.high) return {-1.0, 1.0};
  const double room = std::max(margin * (range.high - range.low), 0.05);
  return {range.low - room, range.high + room};
}

void draw_grid(const Look& look, const Accuracy& accuracy, const Axes& axes, ImDrawList& draw) {
  const Theme& t = *look.theme;
  const ImU32 line = fade(t.faint, t.dark ? 0.28F : 0.4F);
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
    const ImVec2 size = text_size(look.fonts.small, text.c_str());
    draw_text(draw, look.fonts.small, {axes.min.x - size.x - 6.0F, y - 0.5F * size.y}, t.dim,
              text.c_str());
  }
  float taken = axes.min.x - 20.0F;  // right end of the label before
  for (int e = static_cast<int>(std::floor(axes.cost.low)); e <= static_cast<int>(axes.cost.high);
       ++e) {
    for (const double m : {1.0, 2.0, 5.0}) {
      const double value = m * std::pow(10.0, e);
      const float x = std::round(axes.x(value));
      if (x < axes.min.x || x > axes.max.x) continue;
      draw.AddLine({x, axes.min.y}, {x, axes.max.y}, line);
      const std::string text = plain_number(value);
      const float width = text_size(look.fonts.small, text.c_str()).x;
      if (x - 0.5F * width < taken + 6.0F || x + 0.5F * width > axes.max.x + 8.0F) continue;
      draw_text(draw, look.fonts.small, {x - 0.5F * width, axes.max.y + 4.0F}, t.dim, text.c_str());
      taken = x + 0.5F * width;
    }
  }
  const std::string name =
      fitted(look.fonts.small, axis_name(accuracy.cost), axes.max.x - axes.min.x);
  const float width = text_size(look.fonts.small, name.c_str()).x;
  draw_text(draw, look.fonts.small, {0.5F * (axes.min.x + axes.max.x - width), axes.max.y + 20.0F},
            t.dim, name.c_str());
}

void draw_cross(ImDrawList& draw, ImVec2 at, ImU32 color) {
  constexpr float kArm = 3.2F;
  draw.AddLine({at.x - kArm, at.y - kArm}, {at.x + kArm, at.y + kArm}, color, 1.6F);
  draw.AddLine({at.x - kArm, at.y + kArm}, {at.x + kArm, at.y - kArm}, color, 1.6F);
}

/// The front as a broad band: from each of its points as far as the next is not yet paid for.
void draw_front(const Look& look, const std::vector<Point>& points, const Axes& axes,
                ImDrawList& draw) {
  std::vector<Point> front;
  for (const Point& p : points) {
    if (p.front) front.push_back(p);
  }
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.cost < b.cost; });
  const ImU32 band = fade(look.theme->amber, look.theme->dark ? 0.3F : 0.26F);
  for (std::size_t i = 0; i < front.size(); ++i) {
    const ImVec2 from = axes.at(front[i]);
    if (i + 1 == front.size()) {
      draw.AddRectFilled({from.x - 4.0F, from.y - 4.0F}, {from.x + 4.0F, from.y + 4.0F}, band);
      break;
    }
    const ImVec2 to = axes.at(front[i + 1]);
    draw.AddRectFilled({from.x - 4.0F, from.y - 4.0F}, {to.x + 4.0F, from.y + 4.0F}, band);
    draw.AddRectFilled({to.x - 4.0F, from.y + 4.0F},
                       {to.x + 4.0F, std::max(from.y + 4.0F, to.y - 4.0F)}, band);
  }
}

void draw_curves(const Look& look, const Accuracy& accuracy, const std::vector<Point>& points,
                 const Axes& axes, ImDrawList& draw) {
  std::map<std::string, std::vector<Point>> curves;
  for (const Point& p : points) {
    curves[series_name(accuracy.results()[p.result].experiment.settings)].push_back(p);
  }
  for (auto& [name, curve] : curves) {
    const auto parameter = [&](const Point& p) {
      return series_parameter(accuracy.results()[p.result].experiment.settings).value;
    };
    std::sort(curve.begin(), curve.end(),
              [&](const Point& a, const Point& b) { return parameter(a) < parameter(b); });
    const CurveStyle style =
        curve_style(*look.theme, accuracy.results()[curve.front().result].experiment.settings);
    float phase = 0.0F;
    for (std::size_t i = 1; i < curve.size(); ++i) {
      const ImVec2 a = axes.at(curve[i - 1]);
      const ImVec2 b = axes.at(curve[i]);
      if (style.dashed) {
        draw_dashes(draw, a, b, style.color, 1.5F, phase);
      } else {
        draw.AddLine(a, b, style.color, 1.5F);
      }
    }
    for (const Point& p : curve) draw_point(style, look.theme->well, draw, axes.at(p));
  }
}

void read_point(const Look& look, const Accuracy& accuracy, const Result& result) {
  const Theme& t = *look.theme;
  const Settings& s = result.experiment.settings;
  const SeriesParameter parameter = series_parameter(s);
  std::vector<ReadOutLine> lines{{curve_style(t, s).name(), t.text, true}};
  const auto line = [&](std::string text) { lines.push_back({std::move(text), t.dim}); };
  line(std::string(parameter.name) + " = " + plain_number(parameter.value));
  if (const auto error = error_of(result, accuracy.error)) {
    line(short_number(*error) + "  " + axis_name(accuracy.error));
  }
  line(short_number(cost_of(result, accuracy.cost)) + "  " + axis_name(accuracy.cost));
  if (!result.metrics.holds) {
    lines.push_back({verdict_words(result.metrics.verdict), t.orange});
  }
  lines.push_back({"Click to run it", t.accent});
  read_out(look, lines);
}

}  // namespace

std::optional<std::size_t> accuracy_picture(const Look& look, const Accuracy& accuracy,
                                            const Settings& current, ImVec2 size) {
  const Theme& t = *look.theme;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("accuracy picture", size);
  const bool hovered = ImGui::IsItemHovered();
  draw.AddRectFilled(origin, {origin.x + size.x, origin.y + size.y}, t.well, look.m.radius);

  const std::vector<Point> points = accuracy.points();
  const std::vector<Point> failed = accuracy.failed();
  const Axes axes{{origin.x + kErrorGutter, origin.y + kRail + 8.0F},
                  {origin.x + size.x - 12.0F, origin.y + size.y - kFootHeight},
                  range_of(
                      points, failed, [](const Point& p) { return p.cost; }, 0.04),
                  range_of(
                      points, {}, [](const Point& p) { return p.error; }, 0.05)};
  draw_grid(look, accuracy, axes, draw);
  if (!failed.empty()) {  // what stands on the rail over the picture
    const float fails = text_size(look.fonts.small, "fails").x;
    draw_text(draw, look.fonts.small, {axes.min.x - fails - 6.0F, axes.min.y - 18.0F}, t.dim,
              "fails");
  }
  draw_front(look, points, axes, draw);
  draw_curves(look, accuracy, points, axes, draw);
  if (const auto best = accuracy.best(points)) {
    float phase = 0.0F;
    if (accuracy.error_is_given) {
      const double wanted = accuracy.wanted.at(static_cast<std::size_t>(accuracy.error));
      const float y = std::clamp(axes.y(wanted), axes.min.y, axes.max.y);
      draw_dashes(draw, {axes.min.x, y}, {axes.max.x, y}, fade(t.text, 0.5F), 1.0F, phase);
    } else {
      const double budget = accuracy.budget.at(static_cast<std::size_t>(accuracy.cost));
      const float x = std::clamp(axes.x(budget), axes.min.x, axes.max.x);
      draw_dashes(draw, {x, axes.min.y}, {x, axes.max.y}, fade(t.text, 0.5F), 1.0F, phase);
    }
    draw.AddCircle(axes.at(*best), 8.0F, t.accent, 0, 2.0F);
  }

  std::optional<std::size_t> nearest;
  float reach = kReach;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto consider = [&](const Point& p, ImVec2 at) {
    mark(std::to_string(p.result).c_str(), {at.x - 1.0F, at.y - 1.0F}, {at.x + 1.0F, at.y + 1.0F},
         "accuracy picture");
    const Settings& s = accuracy.results()[p.result].experiment.settings;
    Settings same = current;
    same.watch_stiffness = s.watch_stiffness;
    if (same == s) draw.AddCircle(at, 8.0F, t.text, 0, 1.5F);
    const float distance = std::hypot(mouse.x - at.x, mouse.y - at.y);
    if (!hovered || distance >= reach) return;
    reach = distance;
    nearest = p.result;
  };
  for (const Point& p : failed) {
    const Result& result = accuracy.results()[p.result];
    const ImVec2 at = axes.on_rail(p, result.experiment.settings.solver == SolverKind::kPgs);
    draw_cross(draw, at, curve_style(t, result.experiment.settings).color);
    consider(p, at);
  }
  for (const Point& p : points) consider(p, axes.at(p));
  if (nearest) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    read_point(look, accuracy, accuracy.results()[*nearest]);
  }
  return clicked ? nearest : std::nullopt;
}

}  // namespace substep::ui
