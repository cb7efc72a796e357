#pragma once
// Appearance of the application: colours, fonts and metrics. Lengths are logical pixels on a grid
// of 4.

#include <imgui.h>

#include <cstddef>

#include "app/render/scene_view.hpp"

namespace substep::ui {

struct Theme {
  bool dark = true;
  ImU32 panel = 0;
  ImU32 panel_border = 0;
  ImU32 raised = 0;   // menus, tooltips and cards: over panels
  ImU32 well = 0;     // background of plots and segments
  ImU32 control = 0;  // buttons at rest
  ImU32 control_hover = 0;
  ImU32 track = 0;  // of sliders
  ImU32 text = 0;
  ImU32 dim = 0;    // secondary text (WCAG AA on the panel)
  ImU32 faint = 0;  // grid lines, disabled items
  ImU32 accent = 0;
  ImU32 accent_hover = 0;
  ImU32 on_accent = 0;
  // Series and states, distinguishable with red-green colour blindness.
  ImU32 blue = 0;
  ImU32 orange = 0;
  ImU32 teal = 0;
  ImU32 amber = 0;
  ImU32 purple = 0;
  ImU32 grey = 0;
  ViewPalette view;
};

const Theme& dark_theme();
const Theme& light_theme();

struct Fonts {
  ImFont* regular = nullptr;
  ImFont* small = nullptr;
  ImFont* medium = nullptr;
  ImFont* small_medium = nullptr;
  ImFont* caps = nullptr;  // headings of sections
  ImFont* title = nullptr;
  ImFont* large = nullptr;  // the principal number
};

struct Metrics {
  float row = 26.0F;  // height of a control
  float gap = 8.0F;
  float section = 13.0F;  // between sections
  float pad = 16.0F;      // inside a panel
  float margin = 12.0F;   // around panels
  float radius = 6.0F;
  float panel_radius = 10.0F;
};

struct Look {
  const Theme* theme = nullptr;
  Fonts fonts;
  Metrics m;
};

/// Of a window whose place the application sets.
inline constexpr ImGuiWindowFlags kPlaced = ImGuiWindowFlags_NoTitleBar |
                                            ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                            ImGuiWindowFlags_NoSavedSettings;

/// Rasterises the fonts for a pixel ratio and replaces the atlas.
Fonts build_fonts(float pixel_ratio);

/// Sets the style of Dear ImGui's own widgets (menus, tooltips, scroll bars).
void apply_style(const Look& look);

inline ImVec4 to_vec4(ImU32 color) { return ImGui::ColorConvertU32ToFloat4(color); }
/// A colour of the picture, with another opacity.
ImU32 to_u32(const Color& color, float opacity);
/// The colour of a compared run, in plots and in the picture. @param run from 0
ImU32 compare_color(const Look& look, std::size_t run);
/// The same colour, less opaque.
ImU32 fade(ImU32 color, float opacity);

}  // namespace substep::ui
