#pragma once

#include <imgui.h>

#include <cmath>
#include <vector>

#include "app/lab/accuracy.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

struct LogRange {  // of logarithms
  double low = 0.0;
  double high = 1.0;
};

/// Maps costs and errors to the screen.
struct AccuracyAxes {
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
  [[nodiscard]] ImVec2 at(const Accuracy::Point& p) const { return {x(p.cost), y(p.error)}; }
  /// On the rail above the picture; PGS slightly higher, so that both solvers are visible.
  [[nodiscard]] ImVec2 on_rail(const Accuracy::Point& p, bool higher) const {
    return {x(p.cost), min.y - (higher ? 15.0F : 6.0F)};
  }
};

/// The axes for these points in a picture of this size, including the floor if points lie on it.
AccuracyAxes accuracy_axes(const Accuracy& accuracy, const std::vector<Accuracy::Point>& points,
                           const std::vector<Accuracy::Point>& failed, ImVec2 origin, ImVec2 size);

void draw_accuracy_grid(const Look& look, const Accuracy& accuracy, const AccuracyAxes& axes,
                        ImDrawList& draw);
/// Errors below the uncertainty of the reference, shaded.
void draw_floor(const Look& look, const Accuracy& accuracy, const AccuracyAxes& axes,
                ImDrawList& draw);

}  // namespace substep::ui
