#pragma once

#include <imgui.h>

#include <string>

#include "app/ui/look.hpp"
#include "core/model/methods.hpp"
#include "core/model/settings.hpp"

namespace substep::ui {

/// How a method's curve looks: colour by mode, hollow with leapfrog and Störmer, dashed where the
/// solver sweeps.
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
ImU32 color_of(const Theme& theme, Tint tint);

/// Line and point of a curve, as they stand before its name.
void draw_swatch(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 centre);
/// A point of it. @param ground what a hollow one is filled with
void draw_point(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 at);
/// A dashed line. @param phase where in a dash it begins, and then where the next one does [px]
void draw_dashes(ImDrawList& draw, ImVec2 a, ImVec2 b, ImU32 color, float width, float& phase);

}  // namespace substep::ui
