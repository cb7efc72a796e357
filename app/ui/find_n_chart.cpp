// N and the error of the paper's method along alpha: two plots over one axis.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/accuracy_axes.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kAlphaGutter = 40.0F;  // labels of the vertical axes
constexpr float kAlphaTitle = 20.0F;   // above each plot
constexpr float kAlphaFoot = 36.0F;    // labels and name of alpha
constexpr float kAlphaPlot = 92.0F;    // height of a plot
constexpr float kAlphaRadius = 3.5F;

/// A plot of a positive quantity over alpha, both logarithmic.
struct AlphaPlot {
  ImVec2 min;
  ImVec2 max;
  LogRange alpha;
  LogRange value;

  [[nodiscard]] float x(double a) const {
    return min.x + static_cast<float>((std::log10(a) - alpha.low) / (alpha.high - alpha.low)) *
                       (max.x - min.x);
  }
  [[nodiscard]] float y(double v) const {
    const double share = (std::log10(v) - value.low) / (value.high - value.low);
    return max.y - static_cast<float>(std::clamp(share, 0.0, 1.0)) * (max.y - min.y);
  }
};

/// From all values, with room at both ends. @param least of the range, in decades
LogRange alpha_plot_range(const std::vector<double>& values, double least) {
  LogRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double v : values) {
    if (!(v > 0.0) || !std::isfinite(v)) continue;
    range.low = std::min(range.low, std::log10(v));
    range.high = std::max(range.high, std::log10(v));
  }
  if (range.low > range.high) return {0.0, 1.0};
  const double room =
      0.08 * (range.high - range.low) + 0.5 * std::max(0.0, least - (range.high - range.low));
  return {range.low - room, range.high + room};
}

void alpha_plot_grid(const Look& look, const AlphaPlot& plot, bool powers, ImDrawList& draw) {
  const Theme& t = *look.theme;
  const ImU32 line = fade(t.faint, t.dark ? 0.28F : 0.4F);
  const double decades = plot.value.high - plot.value.low;
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 4.5)));
  float last = std::numeric_limits<float>::infinity();  // of the label below
  for (int e = static_cast<int>(std::floor(plot.value.low));
       e <= static_cast<int>(std::floor(plot.value.high)); ++e) {
    for (const double m : {1.0, 2.0, 5.0}) {
      const double v = m * std::pow(10.0, e);
      if (std::log10(v) < plot.value.low || std::log10(v) > plot.value.high) continue;
      if (powers && m != 1.0) continue;
      const float y = std::round(plot.y(v));
      draw.AddLine({plot.min.x, y}, {plot.max.x, y}, line);
      if (powers && e % every != 0) continue;
      const std::string text = powers ? power_of_ten(e) : plain_number(v);
      const ImVec2 size = text_size(look.fonts.small, text);
      if (y + size.y > last) continue;
      last = y;
      draw_text(look.fonts.small, {plot.min.x - size.x - 6.0F, y - 0.5F * size.y}, t.dim, text);
    }
  }
  draw.AddRect(plot.min, plot.max, fade(t.faint, 0.6F));
}

void alpha_axis(const Look& look, const AlphaPlot& plot) {
  const Theme& t = *look.theme;
  for (const double a : {0.01, 0.03, 0.1, 0.3, 1.0}) {
    const float x = std::round(plot.x(a));
    if (x < plot.min.x || x > plot.max.x) continue;
    const std::string text = plain_number(a);
    draw_text(look.fonts.small, {x - 0.5F * text_size(look.fonts.small, text).x, plot.max.y + 3.0F},
              t.dim, text);
  }
  const std::string name = "alpha of the paper's method";
  const float width = text_size(look.fonts.small, name).x;
  draw_text(look.fonts.small, {0.5F * (plot.min.x + plot.max.x - width), plot.max.y + 18.0F}, t.dim,
            name);
}

/// A horizontal line with its name above its right end, below it near the top.
void alpha_level(const Look& look, const AlphaPlot& plot, double value, const std::string& name,
                 ImU32 color, ImDrawList& draw) {
  const float y = std::round(plot.y(value));
  draw_dashes(draw, {plot.min.x, y}, {plot.max.x, y}, color, 1.5F);
  const std::string text = fitted(look.fonts.small, name, plot.max.x - plot.min.x - 8.0F);
  const ImVec2 size = text_size(look.fonts.small, text);
  const bool below = y - size.y - 1.0F < plot.min.y;
  const ImVec2 at(plot.max.x - size.x - 4.0F, below ? y + 2.0F : y - size.y - 1.0F);
  draw.AddRectFilled({at.x - 2.0F, at.y}, {at.x + size.x + 2.0F, at.y + size.y},
                     fade(look.theme->panel | IM_COL32_A_MASK, 0.85F));
  draw_text(look.fonts.small, at, color, text);
}

/// The points with a line through neighbours that hold; a cross where the run fails.
void alpha_curve(const AlphaPlot& plot, const std::vector<FindN::AlphaPoint>& points,
                 double (*value)(const FindN::AlphaPoint&), ImU32 color, ImU32 failed,
                 ImDrawList& draw) {
  std::optional<ImVec2> before;
  for (const FindN::AlphaPoint& p : points) {
    const double v = value(p);
    if (!(v > 0.0)) {
      before.reset();
      continue;
    }
    const ImVec2 at(plot.x(p.alpha), plot.y(v));
    if (before && p.holds) draw.AddLine(*before, at, color, 2.0F);
    if (p.holds) {
      draw.AddCircleFilled(at, kAlphaRadius, color);
      before = at;
    } else {
      draw.AddLine({at.x - 4, at.y - 4}, {at.x + 4, at.y + 4}, failed, 2.0F);
      draw.AddLine({at.x - 4, at.y + 4}, {at.x + 4, at.y - 4}, failed, 2.0F);
      before.reset();
    }
  }
}

double alpha_n(const FindN::AlphaPoint& p) { return p.n; }
double alpha_error(const FindN::AlphaPoint& p) { return p.error.value_or(0.0); }

void read_alpha(const Look& look, const FindN& find, const FindN::AlphaPoint& p) {
  const Theme& t = *look.theme;
  std::vector<ReadOutLine> lines{{"alpha = " + plain_number(p.alpha), t.text, true},
                                 {"N = " + coarse_number(p.n) + " on average", t.dim}};
  if (!p.holds) {
    lines.push_back({verdict_words(p.result->metrics.verdict), t.orange});
  } else if (p.error) {
    lines.push_back({"Error " + error_text(*p.error, find.axis()), t.dim});
  }
  lines.push_back({"Click to run it", t.accent});
  read_out(look, lines);
}

}  // namespace

const Result* find_n_chart(const Look& look, const FindN& find, float width) {
  const Theme& t = *look.theme;
  const std::vector<FindN::AlphaPoint> points = find.along_alpha();
  const Result* best = find.best();
  std::vector<double> alphas{0.00625, 1.0};
  std::vector<double> ns;
  std::vector<double> errors{find.limit()};
  for (const FindN::AlphaPoint& p : points) {
    alphas.push_back(p.alpha);
    ns.push_back(p.n);
    if (p.error) errors.push_back(*p.error);
  }
  if (best != nullptr) ns.push_back(cost_of(*best, CostAxis::kSubsteps));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const LogRange along = alpha_plot_range(alphas, 0.5);
  const float left = corner.x + kAlphaGutter;
  const float right = corner.x + width - 4.0F;
  const float first = corner.y + kAlphaTitle;
  const AlphaPlot upper{
      {left, first}, {right, first + kAlphaPlot}, along, alpha_plot_range(ns, 0.8)};
  const float second = upper.max.y + kAlphaTitle + 6.0F;
  const AlphaPlot lower{
      {left, second}, {right, second + kAlphaPlot}, along, alpha_plot_range(errors, 2.2)};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_text(look.fonts.small, corner, t.dim, "N: mean sub-steps per frame");
  draw_text(look.fonts.small, {corner.x, upper.max.y + 6.0F}, t.dim,
            fitted(look.fonts.small, axis_name(find.axis()), width));
  alpha_plot_grid(look, upper, false, draw);
  alpha_plot_grid(look, lower, true, draw);
  alpha_axis(look, lower);
  if (best != nullptr) {
    const double n = cost_of(*best, CostAxis::kSubsteps);
    alpha_level(look, upper, n, "cheapest: " + coarse_number(n), t.text, draw);
  }
  alpha_level(look, lower, find.limit(), error_text(find.limit(), find.axis()), t.text, draw);
  alpha_curve(upper, points, alpha_n, t.blue, t.orange, draw);
  alpha_curve(lower, points, alpha_error, t.blue, t.orange, draw);

  // A column of both plots for every run.
  const Result* chosen = nullptr;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float x = upper.x(points[i].alpha);
    const float before = i == 0 ? right : 0.5F * (x + upper.x(points[i - 1].alpha));
    const float after = i + 1 == points.size() ? std::max(left, x - 8.0F)
                                               : 0.5F * (x + upper.x(points[i + 1].alpha));
    ImGui::SetCursorScreenPos({after, upper.min.y});
    ImGui::PushID(static_cast<int>(i));
    if (marked_button("alpha", {std::max(2.0F, before - after), lower.max.y - upper.min.y},
                      plain_number(points[i].alpha), "find alpha")) {
      chosen = points[i].result;
    }
    ImGui::PopID();
    draw_focus(look);
    if (ImGui::IsItemHovered() || ImGui::IsItemFocused()) {
      draw.AddLine({x, upper.min.y}, {x, upper.max.y}, fade(t.dim, 0.6F));
      draw.AddLine({x, lower.min.y}, {x, lower.max.y}, fade(t.dim, 0.6F));
    }
    if (ImGui::IsItemHovered()) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
      read_alpha(look, find, points[i]);
    }
  }
  ImGui::SetCursorScreenPos({corner.x, lower.max.y + kAlphaFoot});
  ImGui::Dummy({width, 1.0F});
  return chosen;
}

}  // namespace substep::ui
