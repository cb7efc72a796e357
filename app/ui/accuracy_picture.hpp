#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "app/accuracy.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// How a method's curve looks: colour by mode, hollow with leapfrog and Störmer, dashed with PGS.
struct CurveStyle {
  ImU32 color = 0;
  bool hollow = false;
  bool dashed = false;
  int corners = 0;       // of its points, 0 a disc
  std::string family;    // "BPP, leapfrog": solver and, where it has a choice of them, integrator
  std::string own_name;  // within it: "adaptive per frame"

  [[nodiscard]] std::string name() const { return family + ", " + own_name; }
};
CurveStyle curve_style(const Theme& theme, const Settings& settings);

/// Line and point of a curve, as they stand before its name.
void draw_swatch(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 centre);

/// Error against cost, both logarithmic: a curve per method, the Pareto front, the failed runs on a
/// rail of their own. @param current settings of the run, ringed @return the result that was
/// clicked
std::optional<std::size_t> accuracy_picture(const Look& look, const Accuracy& accuracy,
                                            const Settings& current, ImVec2 size);

}  // namespace substep::ui
