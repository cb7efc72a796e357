#include "app/ui/accuracy_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/accuracy_axes.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/plot_labels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kReach = 14.0F;  // hover distance of a point

using Point = Accuracy::Point;

void draw_cross(ImDrawList& draw, ImVec2 at, ImU32 color) {
  constexpr float kArm = 3.2F;
  draw.AddLine({at.x - kArm, at.y - kArm}, {at.x + kArm, at.y + kArm}, color, 1.6F);
  draw.AddLine({at.x - kArm, at.y + kArm}, {at.x + kArm, at.y - kArm}, color, 1.6F);
}

/// The front as a broad staircase: each point extends to the cost of the next.
void draw_front(const Look& look, const std::vector<Point>& points, const AccuracyAxes& axes,
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

/// Whether its error is below the uncertainty of the reference.
bool on_floor(const Accuracy& accuracy, const Point& p) { return p.error <= accuracy.floor(); }

void draw_curve(const Look& look, const Accuracy& accuracy, const AccuracyCurve& curve,
                const AccuracyAxes& axes, float width, ImDrawList& draw) {
  float phase = 0.0F;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const ImVec2 a = axes.at(curve.points[i - 1]);
    const ImVec2 b = axes.at(curve.points[i]);
    if (curve.style.dashed) {
      draw_dashes(draw, a, b, curve.style.color, width, phase);
    } else {
      draw.AddLine(a, b, curve.style.color, width);
    }
  }
  for (const Point& p : curve.points) {
    const ImVec2 at = axes.at(p);
    if (on_floor(accuracy, p)) {  // an upper bound: it points down
      draw.AddTriangle({at.x - 4.0F, at.y + 2.0F}, {at.x + 4.0F, at.y + 2.0F}, {at.x, at.y + 8.0F},
                       curve.style.color, 1.5F);
    } else {
      draw_point(curve.style, look.theme->well, draw, at);
    }
  }
}

/// Behind the others, in grey.
void draw_grey(const Look& look, const AccuracyCurve& curve, const AccuracyAxes& axes,
               ImDrawList& draw) {
  const ImU32 color = fade(look.theme->dim, look.theme->dark ? 0.34F : 0.4F);
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    draw.AddLine(axes.at(curve.points[i - 1]), axes.at(curve.points[i]), color, 1.0F);
  }
  for (const Point& p : curve.points) draw.AddCircleFilled(axes.at(p), 1.6F, color);
}

/// Labels at the ends of curves, on the background of the picture.
/// @param bottom lower limit of the labels
void draw_curve_names(const Look& look, const std::vector<const AccuracyCurve*>& curves,
                      const AccuracyAxes& axes, float bottom, ImDrawList& draw) {
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
    const ImVec2 extent = text_size(look.fonts.small, curves[i]->name.c_str());
    const bool right = ends[i].x + 10.0F + extent.x <= axes.max.x;
    const ImVec2 at(
        right ? ends[i].x + 10.0F : std::max(axes.min.x + 2.0F, ends[i].x - 10.0F - extent.x),
        places[i].y - 0.5F * extent.y);
    draw.AddRectFilled({at.x - 3.0F, at.y}, {at.x + extent.x + 3.0F, at.y + extent.y},
                       fade(look.theme->well, 0.8F), 3.0F);
    draw_text(draw, look.fonts.small, at, curves[i]->style.color, curves[i]->name.c_str());
  }
}

void read_point(const Look& look, const Accuracy& accuracy, const Result& result) {
  const Theme& t = *look.theme;
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
  read_out(look, lines);
}

void draw_limit(const Look& look, const Accuracy& accuracy, const std::vector<Point>& points,
                const AccuracyAxes& axes, ImDrawList& draw) {
  const auto best = accuracy.best(points);
  if (!best) return;
  const Theme& t = *look.theme;
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

/// Contents of the picture and what the pointer is on.
struct Scatter {
  std::vector<Point> points;
  std::vector<Point> failed;
  std::vector<AccuracyCurve> curves;
  AccuracyAxes axes;

  [[nodiscard]] ImVec2 place(const Accuracy& accuracy, const Point& p, bool holds) const {
    const Settings& s = accuracy.results()[p.result].experiment.settings;
    return holds ? axes.at(p) : axes.on_rail(p, s.solver == SolverKind::kPgs);
  }
};

/// The result under the pointer if `hovered`; records the handles of all points.
std::optional<std::size_t> point_at(const Accuracy& accuracy, const Scatter& scatter,
                                    bool hovered) {
  std::optional<std::size_t> nearest;
  float reach = kReach;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto consider = [&](const Point& p, ImVec2 at) {
    mark(std::to_string(p.result).c_str(), {at.x - 1.0F, at.y - 1.0F}, {at.x + 1.0F, at.y + 1.0F},
         "accuracy picture");
    const float distance = std::hypot(mouse.x - at.x, mouse.y - at.y);
    if (!hovered || distance >= reach) return;
    reach = distance;
    nearest = p.result;
  };
  for (const Point& p : scatter.failed) consider(p, scatter.place(accuracy, p, false));
  for (const Point& p : scatter.points) consider(p, scatter.place(accuracy, p, true));
  return nearest;
}

void draw_failed(const Look& look, const Accuracy& accuracy, const Scatter& scatter,
                 ImDrawList& draw) {
  if (scatter.failed.empty()) return;
  const Theme& t = *look.theme;
  const float fails = text_size(look.fonts.small, "fails").x;
  draw_text(draw, look.fonts.small, {scatter.axes.min.x - fails - 6.0F, scatter.axes.min.y - 18.0F},
            t.dim, "fails");
  for (const Point& p : scatter.failed) {
    const Settings& s = accuracy.results()[p.result].experiment.settings;
    ImU32 color = accuracy.all_methods ? curve_style(t, s).color : fade(t.dim, 0.5F);
    for (const AccuracyCurve& curve : scatter.curves) {
      if (curve.headline && curve.series == series_name(s)) color = curve.style.color;
    }
    draw_cross(draw, scatter.place(accuracy, p, false), color);
  }
}

/// A ring around the point of the current run.
void ring_current(const Look& look, const Accuracy& accuracy, const Settings& current,
                  const Scatter& scatter, ImDrawList& draw) {
  const auto ring = [&](const Point& p, bool holds) {
    const Settings& s = accuracy.results()[p.result].experiment.settings;
    Settings same = current;
    same.watch_stiffness = s.watch_stiffness;
    if (same != s) return;
    draw.AddCircle(scatter.place(accuracy, p, holds), 8.0F, look.theme->text, 0, 1.5F);
  };
  for (const Point& p : scatter.failed) ring(p, false);
  for (const Point& p : scatter.points) ring(p, true);
}

/// Grey curves first, then coloured ones, then the one under the pointer.
void draw_curves(const Look& look, const Accuracy& accuracy, const Scatter& scatter,
                 const std::string& pointed, ImDrawList& draw) {
  std::vector<const AccuracyCurve*> named;
  const AccuracyCurve* last = nullptr;
  for (const AccuracyCurve& curve : scatter.curves) {
    if (curve.series == pointed) last = &curve;
    if (curve.headline || &curve == last) named.push_back(&curve);
    if (!curve.headline && !accuracy.all_methods) draw_grey(look, curve, scatter.axes, draw);
  }
  for (const AccuracyCurve& curve : scatter.curves) {
    if (curve.headline || accuracy.all_methods) {
      draw_curve(look, accuracy, curve, scatter.axes, 1.5F, draw);
    }
  }
  if (last != nullptr) draw_curve(look, accuracy, *last, scatter.axes, 2.5F, draw);
  const double floor = accuracy.floor();
  const float bottom = floor > 0.0 ? scatter.axes.y(floor) : scatter.axes.max.y;
  draw_curve_names(look, named, scatter.axes, std::min(bottom, scatter.axes.max.y), draw);
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

  Scatter scatter{accuracy.points(), accuracy.failed(), {}, {}};
  scatter.curves = curves_of(t, accuracy, scatter.points);
  scatter.axes = accuracy_axes(accuracy, scatter.points, scatter.failed, origin, size);
  const std::optional<std::size_t> pointed = point_at(accuracy, scatter, hovered);
  draw_accuracy_grid(look, accuracy, scatter.axes, draw);
  draw_floor(look, accuracy, scatter.axes, draw);
  draw_front(look, scatter.points, scatter.axes, draw);
  draw_limit(look, accuracy, scatter.points, scatter.axes, draw);
  draw_curves(look, accuracy, scatter,
              pointed ? series_name(accuracy.results()[*pointed].experiment.settings) : "", draw);
  draw_failed(look, accuracy, scatter, draw);
  ring_current(look, accuracy, current, scatter, draw);
  if (pointed) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    read_point(look, accuracy, accuracy.results()[*pointed]);
  }
  return clicked ? pointed : std::nullopt;
}

}  // namespace substep::ui
