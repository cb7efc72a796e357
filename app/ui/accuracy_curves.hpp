#pragma once

#include <string>
#include <vector>

#include "app/lab/accuracy.hpp"
#include "app/ui/curve_style.hpp"

namespace substep::ui {

/// The points of one method, along its own parameter.
struct AccuracyCurve {
  std::string series;
  std::vector<Accuracy::Point> points;
  CurveStyle style;
  std::string name;  // label at its end: "Störmer", or "Cheapest" if the point is on no other curve
  bool headline = false;  // drawn in colour and named
};

/// "Constant N", "Adaptive, leapfrog", "PGS, constant N": the direct solver and Euler are omitted.
std::string short_name(const Settings& settings);

/// The curves of these points. The headline curves are that of the best point and up to five common
/// ones: constant N, the paper's method, higher orders, Newton, Gauss-Seidel.
std::vector<AccuracyCurve> curves_of(const Theme& theme, const Accuracy& accuracy,
                                     const std::vector<Accuracy::Point>& points);

/// The picture's conclusion in a sentence: "To keep the path within 1 mm, Constant N, Störmer
/// (n = 3) is the cheapest: 65 times fewer operations than constant N with Euler." "" with fewer
/// than two points.
std::string conclusion(const Accuracy& accuracy, const std::vector<Accuracy::Point>& points);

/// "1 mm", "0.05 ms per frame": the required limit.
std::string limit_text(const Accuracy& accuracy);
/// "0.82 mm", "3.1 J"
std::string error_text(double error, ErrorAxis axis);
/// "12 sub-steps per frame"
std::string cost_text(double cost, CostAxis axis);

}  // namespace substep::ui
