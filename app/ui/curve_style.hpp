#pragma once

#include <imgui.h>

#include <string>

#include "app/ui/look.hpp"
#include "core/model/methods.hpp"
#include "core/model/settings.hpp"

namespace substep::ui {

/// Style of a method's curve: colour by mode, hollow for leapfrog and Störmer, dashed for an
/// iterative solver.
struct CurveStyle {
  ImU32 color = 0;
  bool hollow = false;
  bool dashed = false;
  int corners = 0;       // of its points, 0 a disc
  std::string family;    // "BPP, leapfrog": solver, and integrator if it offers a choice
  std::string own_name;  // within the family: "adaptive per frame"

  [[nodiscard]] std::string name() const { return family + ", " + own_name; }
};
CurveStyle curve_style(const Theme& theme, const Settings& settings);
/// Name and value of the setting that varies along a method's curve: "N = 7", "alpha = 0.1".
std::string parameter_text(const Settings& settings);
ImU32 color_of(const Theme& theme, Tint tint);

/// Line and point of a curve, in front of its name.
void draw_swatch(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 centre);
/// A point of the curve. @param ground fill colour of a hollow one
void draw_point(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 at);
/// A dashed line. @param phase start within a dash [px] @return that of a line which continues it
float draw_dashes(ImDrawList& draw, ImVec2 a, ImVec2 b, ImU32 color, float width,
                  float phase = 0.0F);

}  // namespace substep::ui
