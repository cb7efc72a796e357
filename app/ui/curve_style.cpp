#include "app/ui/curve_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/text/format.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/names.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep::ui {
namespace {

/// Colour by mode, and by the rule for N.
void style_of_mode(const Theme& theme, const Settings& s, CurveStyle& style) {
  const ModeEntry& mode = entry_of(s.mode);
  style.color = color_of(theme, mode.tint);
  style.corners = mode.corners;
  style.own_name = mode.curve;
  const bool adaptive = s.mode == Mode::kAdaptive;
  if (adaptive && s.policy == Policy::kSubstep) {
    style.color = theme.purple;
    style.corners = 3;
  }
  if (adaptive) style.own_name += s.policy == Policy::kFrame ? " per frame" : " per sub-step";
  if (has_islands(s)) {
    style.color = adaptive ? theme.teal : style.color;
    style.corners = adaptive ? 6 : 5;
    style.own_name += " by island";
  }
}

/// "25 sweeps per frame", "2 steps"; "" for the default number.
std::string iterations_text(const Settings& s, bool always) {
  if (!reads(s, "iterations")) return "";
  const bool shared = reads(s, "share_iterations") && s.share_iterations;
  if (!always && !shared && s.iterations == Settings{}.iterations) return "";
  return std::to_string(s.iterations) + (entry_of(s.solver).sweeps ? " sweep" : " step") +
         (s.iterations == 1 ? "" : "s") + (shared ? " per frame" : "");
}

/// By the number of iterations; Numerov differs by its colour.
int corners_at_end(const Settings& s) {
  if (entry_of(s.solver).sweeps) return s.iterations == 1 ? 5 : s.share_iterations ? 3 : 4;
  if (s.iterations == 1) return 3;
  if (s.iterations != Settings{}.iterations) return 4;
  return s.forces == Forces::kNumerov ? 5 : 0;
}

/// Solvers that enforce constraints at the end of the sub-step have their own colour, and their
/// name includes the mode only if N is not constant.
void style_at_end(const Theme& theme, const Settings& s, CurveStyle& style) {
  const SolverEntry& solver = entry_of(s.solver);
  const bool plain = s.mode == Mode::kNone || s.mode == Mode::kConst;
  const std::string mode = plain ? "" : ", " + style.own_name;
  const std::string iterations = iterations_text(s, solver.sweeps);
  style.family = solver.title;
  style.color = color_of(theme, solver.tint);
  style.corners = corners_at_end(s);
  style.own_name = iterations;
  if (reads(s, "forces")) {
    if (s.forces == Forces::kNumerov) style.color = theme.blue;
    style.own_name = s.forces == Forces::kEnd    ? "forces at the end"
                     : s.forces == Forces::kMean ? "mean forces"
                                                 : "Numerov";
    if (!iterations.empty()) style.own_name += ", " + iterations;
  }
  style.own_name += mode;
}

void style_of_solver(const Theme& theme, const Settings& s, CurveStyle& style) {
  const SolverEntry& solver = entry_of(s.solver);
  if (solver.at_end) {
    style_at_end(theme, s, style);
    return;
  }
  style.family = std::string(solver.title) + ", " + entry_of(s.integrator).title;
  if (reads(s, "share_iterations") && s.share_iterations) style.corners = 3;
  if (const std::string text = iterations_text(s, false); !text.empty()) {
    style.own_name += ", " + text;
  }
  if (reads(s, "refinements") && s.refinements > 0) {
    style.color = theme.teal;
    style.corners = s.refinements <= 2 ? 3 : 4;
    style.own_name += ", refined " + std::to_string(s.refinements);
  }
}

}  // namespace

std::string parameter_text(const Settings& s) {
  const SeriesParameter parameter = series_parameter(s);
  std::string name = parameter.name;
  if (name == "n") name = "N";
  if (name == "n_cap") name = "N cap";
  return name + " = " + plain_number(parameter.value);
}

ImU32 color_of(const Theme& theme, Tint tint) {
  constexpr std::array kColors{&Theme::blue,   &Theme::orange, &Theme::teal, &Theme::amber,
                               &Theme::purple, &Theme::text,   &Theme::dim};
  return theme.*kColors.at(static_cast<std::size_t>(tint));
}

CurveStyle curve_style(const Theme& theme, const Settings& s) {
  CurveStyle style;
  style.hollow = s.integrator != Integrator::kEuler;
  style.dashed = entry_of(s.solver).sweeps;
  style_of_mode(theme, s, style);
  style_of_solver(theme, s, style);
  // Blue triangles are reserved for Numerov.
  if (follows_accelerations(s)) style.corners = s.mode == Mode::kAdaptive ? 6 : 3;
  if (s.drift_order == 2) {
    style.corners = 5;
    style.own_name += ", drift order 2";
  }
  if (s.contact_stiffness == ContactStiffness::kExact) {
    style.corners = 5;
    style.own_name += ", exact contact block";
  }
  if (s.gyroscopic == Gyroscopic::kExplicit) {
    style.corners = 6;
    style.own_name += ", explicit torque";
  }
  return style;
}

float draw_dashes(ImDrawList& draw, ImVec2 a, ImVec2 b, ImU32 color, float width, float phase) {
  constexpr float kOn = 5.0F;
  constexpr float kOff = 4.0F;
  const ImVec2 d = b - a;
  const float length = std::hypot(d.x, d.y);
  for (float s = -phase; s < length; s += kOn + kOff) {
    const float from = std::clamp(s / length, 0.0F, 1.0F);
    const float to = std::clamp((s + kOn) / length, 0.0F, 1.0F);
    if (to > from) draw.AddLine(a + d * from, a + d * to, color, width);
  }
  return std::fmod(phase + length, kOn + kOff);
}

void draw_point(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 at) {
  constexpr float kRadius = 3.5F;
  const ImU32 inside = style.hollow ? ground : style.color;
  if (style.corners == 0) {
    draw.AddCircleFilled(at, kRadius, inside);
    draw.AddCircle(at, kRadius, style.color, 0, 1.5F);
    return;
  }
  const float r = kRadius * (style.corners == 3 ? 1.35F : 1.2F);
  draw.AddNgonFilled(at, r, inside, style.corners);
  draw.AddNgon(at, r, style.color, style.corners, 1.5F);
}

void draw_swatch(const CurveStyle& style, ImU32 ground, ImDrawList& draw, ImVec2 centre) {
  constexpr ImVec2 kHalf(13.0F, 0.0F);
  if (style.dashed) {
    draw_dashes(draw, centre - kHalf, centre + kHalf, style.color, 1.5F);
  } else {
    draw.AddLine(centre - kHalf, centre + kHalf, style.color, 1.5F);
  }
  draw_point(style, ground, draw, centre);
}

}  // namespace substep::ui
