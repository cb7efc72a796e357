#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/accuracy_axes.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/plot_labels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kReach = 14.0F;  // hover distance of a point

using Point = Accuracy::Point;

void draw_cross(ImDrawList& draw, ImVec2 at, ImU32 color) {
  constexpr float kArm = 3.2F;
  for (const ImVec2 arm : {ImVec2(kArm, kArm), ImVec2(kArm, -kArm)}) {
    draw.AddLine(at - arm, at + arm, color, 1.6F);
  }
}

/// Contents of the picture.
struct Scatter {
  const Look& look;
  const Accuracy& accuracy;
  ImDrawList& draw;
  std::vector<Point> points;
  std::vector<Point> failed;
  std::vector<AccuracyCurve> curves;
  AccuracyAxes axes;

  [[nodiscard]] const Settings& settings_of(const Point& p) const {
    return accuracy.results()[p.result].experiment.settings;
  }
  [[nodiscard]] ImVec2 place(const Point& p, bool holds) const {
    return holds ? axes.at(p) : axes.on_rail(p, settings_of(p).solver == SolverKind::kPgs);
  }
};

/// The front as a broad staircase: each point extends to the cost of the next.
void draw_front(const Scatter& in) {
  std::vector<Point> front;
  std::copy_if(in.points.begin(), in.points.end(), std::back_inserter(front),
               [](const Point& p) { return p.front; });
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.cost < b.cost; });
  const ImU32 band = fade(in.look.theme->amber, in.look.theme->dark ? 0.3F : 0.26F);
  for (std::size_t i = 0; i < front.size(); ++i) {
    const ImVec2 from = in.axes.at(front[i]);
    const ImVec2 to = in.axes.at(front[std::min(i + 1, front.size() - 1)]);
    in.draw.AddRectFilled({from.x - 4.0F, from.y - 4.0F}, {to.x + 4.0F, from.y + 4.0F}, band);
    in.draw.AddRectFilled({to.x - 4.0F, from.y + 4.0F},
                          {to.x + 4.0F, std::max(from.y + 4.0F, to.y - 4.0F)}, band);
  }
}

void draw_curve(const Scatter& in, const AccuracyCurve& curve, float width) {
  float phase = 0.0F;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const ImVec2 a = in.axes.at(curve.points[i - 1]);
    const ImVec2 b = in.axes.at(curve.points[i]);
    if (curve.style.dashed) {
      phase = draw_dashes(in.draw, a, b, curve.style.color, width, phase);
    } else {
      in.draw.AddLine(a, b, curve.style.color, width);
    }
  }
  for (const Point& p : curve.points) {
    const ImVec2 at = in.axes.at(p);
    if (p.error <= in.accuracy.floor()) {  // an upper bound: it points down
      in.draw.AddTriangle({at.x - 4.0F, at.y + 2.0F}, {at.x + 4.0F, at.y + 2.0F},
                          {at.x, at.y + 8.0F}, curve.style.color, 1.5F);
    } else {
      draw_point(curve.style, in.look.theme->well, in.draw, at);
    }
  }
}

/// Behind the others, in grey.
void draw_grey(const Scatter& in, const AccuracyCurve& curve) {
  const ImU32 color = fade(in.look.theme->dim, in.look.theme->dark ? 0.34F : 0.4F);
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    in.draw.AddLine(in.axes.at(curve.points[i - 1]), in.axes.at(curve.points[i]), color, 1.0F);
  }
  for (const Point& p : curve.points) in.draw.AddCircleFilled(in.axes.at(p), 1.6F, color);
}

/// Labels at the ends of curves, on the background of the picture.
/// @param bottom lower limit of the labels
void draw_curve_names(const Scatter& in, const std::vector<const AccuracyCurve*>& curves,
                      float bottom) {
  const AccuracyAxes& axes = in.axes;
  constexpr float kLine = 15.0F;
  std::vector<float> wanted;
  std::vector<ImVec2> ends;
  for (const AccuracyCurve* curve : curves) {
    // At the most accurate end; curves converge towards the other.
    const auto end =
        std::min_element(curve->points.begin(), curve->points.end(),
                         [](const Point& a, const Point& b) { return a.error < b.error; });
    ends.push_back(axes.at(*end));
    wanted.push_back(ends.back().y);
  }
  const std::vector<NamePlace> places = apart(wanted, kLine, axes.min.y, bottom);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!places[i].shown) continue;
    const ImVec2 extent = text_size(in.look.fonts.small, curves[i]->name);
    const bool right = ends[i].x + 10.0F + extent.x <= axes.max.x;
    const ImVec2 at(
        right ? ends[i].x + 10.0F : std::max(axes.min.x + 2.0F, ends[i].x - 10.0F - extent.x),
        places[i].y - 0.5F * extent.y);
    draw_on_ground(in.look, in.draw, at, curves[i]->style.color, curves[i]->name, 0.8F);
  }
}

void read_point(const Scatter& in, const Result& result) {
  const Accuracy& accuracy = in.accuracy;
  const Theme& t = *in.look.theme;
  const Settings& s = result.experiment.settings;
  std::vector<ReadOutLine> lines{{curve_style(t, s).name(), t.text, true}};
  const auto line = [&](std::string text) { lines.push_back({std::move(text), t.dim}); };
  line(parameter_text(s));
  if (const auto error = error_of(result, accuracy.error)) {
    const bool below = *error <= accuracy.floor();
    line((below ? "below " + short_number(accuracy.floor()) : short_number(*error)) + "  " +
         axis_name(accuracy.error));
  }
  line(short_number(cost_of(result, accuracy.cost)) + "  " + axis_name(accuracy.cost));
  if (!result.metrics.holds) {
    lines.push_back({verdict_words(result.metrics.verdict), t.orange});
  }
  lines.push_back({"Click to run it", t.accent});
  read_out(in.look, lines);
}

void draw_limit(const Scatter& in) {
  const Accuracy& accuracy = in.accuracy;
  const AccuracyAxes& axes = in.axes;
  const auto best = accuracy.best(in.points);
  if (!best) return;
  const ImU32 color = fade(in.look.theme->text, 0.5F);
  if (accuracy.error_is_given) {
    const double wanted = accuracy.wanted.at(static_cast<std::size_t>(accuracy.error));
    const float y = std::clamp(axes.y(wanted), axes.min.y, axes.max.y);
    draw_dashes(in.draw, {axes.min.x, y}, {axes.max.x, y}, color, 1.0F);
  } else {
    const double budget = accuracy.budget.at(static_cast<std::size_t>(accuracy.cost));
    const float x = std::clamp(axes.x(budget), axes.min.x, axes.max.x);
    draw_dashes(in.draw, {x, axes.min.y}, {x, axes.max.y}, color, 1.0F);
  }
  in.draw.AddCircle(axes.at(*best), 8.0F, in.look.theme->accent, 0, 2.0F);
}

/// The result under the pointer if `hovered`; records the handles of all points.
std::optional<std::size_t> point_at(const Scatter& in, bool hovered) {
  std::optional<std::size_t> nearest;
  float reach = kReach;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto consider = [&](const Point& p, ImVec2 at) {
    const ImVec2 half(1.0F, 1.0F);
    mark(std::to_string(p.result), at - half, at + half, "accuracy picture");
    const float distance = std::hypot(mouse.x - at.x, mouse.y - at.y);
    if (!hovered || distance >= reach) return;
    reach = distance;
    nearest = p.result;
  };
  for (const Point& p : in.failed) consider(p, in.place(p, false));
  for (const Point& p : in.points) consider(p, in.place(p, true));
  return nearest;
}

void draw_failed(const Scatter& in) {
  if (in.failed.empty()) return;
  const Theme& t = *in.look.theme;
  draw_text_before(in.look.fonts.small, {in.axes.min.x - 6.0F, in.axes.min.y - 18.0F}, t.dim,
                   "fails");
  for (const Point& p : in.failed) {
    const Settings& s = in.settings_of(p);
    ImU32 color = in.accuracy.all_methods ? curve_style(t, s).color : fade(t.dim, 0.5F);
    for (const AccuracyCurve& curve : in.curves) {
      if (curve.headline && curve.series == series_name(s)) color = curve.style.color;
    }
    draw_cross(in.draw, in.place(p, false), color);
  }
}

void ring_current(const Scatter& in, const Settings& current) {
  const auto ring = [&](const Point& p, bool holds) {
    const Settings& s = in.settings_of(p);
    Settings same = current;
    same.watch_stiffness = s.watch_stiffness;
    if (same != s) return;
    in.draw.AddCircle(in.place(p, holds), 8.0F, in.look.theme->text, 0, 1.5F);
  };
  for (const Point& p : in.failed) ring(p, false);
  for (const Point& p : in.points) ring(p, true);
}

/// Grey curves first, then coloured ones, then the one under the pointer.
void draw_curves(const Scatter& in, const std::string& pointed) {
  std::vector<const AccuracyCurve*> named;
  const AccuracyCurve* last = nullptr;
  for (const AccuracyCurve& curve : in.curves) {
    if (curve.series == pointed) last = &curve;
    if (curve.headline || &curve == last) named.push_back(&curve);
    if (!curve.headline && !in.accuracy.all_methods) draw_grey(in, curve);
  }
  for (const AccuracyCurve& curve : in.curves) {
    if (curve.headline || in.accuracy.all_methods) {
      draw_curve(in, curve, 1.5F);
    }
  }
  if (last != nullptr) draw_curve(in, *last, 2.5F);
  const double floor = in.accuracy.floor();
  const float bottom = floor > 0.0 ? in.axes.y(floor) : in.axes.max.y;
  draw_curve_names(in, named, std::min(bottom, in.axes.max.y));
}

}  // namespace

std::optional<std::size_t> accuracy_picture(const Look& look, const Accuracy& accuracy,
                                            const Settings& current, ImVec2 size) {
  const Theme& t = *look.theme;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("accuracy picture", size);
  const bool hovered = ImGui::IsItemHovered();
  draw.AddRectFilled(origin, origin + size, t.well, look.m.radius);

  Scatter in{look, accuracy, draw, accuracy.points(), accuracy.failed(), {}, {}};
  in.curves = curves_of(t, accuracy, in.points);
  in.axes = accuracy_axes(accuracy, in.points, in.failed, origin, size);
  const std::optional<std::size_t> pointed = point_at(in, hovered);
  draw_accuracy_grid(look, accuracy, in.axes, draw);
  draw_floor(look, accuracy, in.axes, draw);
  draw_front(in);
  draw_limit(in);
  draw_curves(in, pointed ? series_name(accuracy.results()[*pointed].experiment.settings) : "");
  draw_failed(in);
  ring_current(in, current);
  if (pointed) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    read_point(in, accuracy.results()[*pointed]);
  }
  return clicked ? pointed : std::nullopt;
}

}  // namespace substep::ui
