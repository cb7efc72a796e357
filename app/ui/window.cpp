// Layout of the window: panels around the picture, or below it on a phone.

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/app.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kBarHeight = 56.0F;  // height of the transport bar

bool begin_panel(const char* id, const ViewRect& r, ImGuiWindowFlags flags = 0) {
  ImGui::SetNextWindowPos({std::round(r.x), std::round(r.y)});
  ImGui::SetNextWindowSize({std::round(r.width), std::round(r.height)});
  return ImGui::Begin(id, nullptr, kPlaced | flags);
}

// A panel opened by a tab. A new one is a separate file and a line here.
struct Panel {
  Tab tab;
  Choice name;
  void (*draw)(App& app, float height);
};

void draw_plots(App& app, float height) {
  const Look& look = app.look;
  const bool brief = height < 640.0F;
  const bool timed = app.desk.level == DeskLevel::kLab;
  float below = why_summary_height() + look.m.section;
  if (timed) below += timing_height(look, app.session, brief) + look.m.section;
  plots(look, app, app.desk, app, height - below);
  space(look.m.section);
  why_summary(look, app.session, app.desk);
  if (!timed) return;
  space(look.m.section);
  timing(look, app.session, brief);
}

// Beside the picture the controls are always open; the others share a panel.
constexpr std::array<Panel, 5> kPanels{
    {{Tab::kControls,
      {"Controls", "Scene and solution method"},
      [](App& app, float) { controls(app.look, app, app.desk, app); }},
     {Tab::kPlots, {"Plots", "Results of every frame"}, draw_plots},
     {Tab::kWhy,
      {"Why N", "The body that determines the number of sub-steps"},
      [](App& app, float) {
        find_n_button(app.look, app, app.desk);
        space(app.look.m.section);
        why(app.look, app.session, app.desk);
      }},
     {Tab::kCompare,
      {"Compare", "Comparison with other methods"},
      [](App& app, float) { compare(app.look, app, app.desk); }},
     {Tab::kAccuracy,
      {"Accuracy", "What does accuracy cost? All methods on this scene"},
      [](App& app, float) { accuracy(app.look, app, app.desk); }}}};

// The panel of a tab, or the first.
const Panel& panel_of(std::span<const Panel> panels, Tab tab) {
  for (const Panel& panel : panels) {
    if (panel.tab == tab) return panel;
  }
  return panels.front();
}

// Tabs across the panel. @return the open panel, or the first
const Panel& choose_panel(const Look& look, std::span<const Panel> panels, Tab& tab) {
  std::vector<Choice> names;
  for (const Panel& panel : panels) names.push_back(panel.name);
  auto current = static_cast<int>(&panel_of(panels, tab) - panels.data());
  const bool changed = segmented(look, "tabs", names, current, ImGui::GetContentRegionAvail().x);
  const Panel& open = panels[static_cast<std::size_t>(current)];
  if (changed) tab = open.tab;
  return open;
}

// The panels of the level, in the order of kPanels: Explore has the plots, and the explanation of N
// while it is open.
std::span<const Panel> panels_of(const Desk& desk) {
  const std::span<const Panel> all(kPanels);
  if (desk.level == DeskLevel::kLab) return all;
  return all.first(desk.tab == Tab::kWhy ? 3 : 2);
}

// Contents of the right panel.
void instruments(App& app, float height) {
  const auto panels = panels_of(app.desk).subspan(1);
  if (panels.size() == 1) return panels.front().draw(app, height);
  choose_panel(app.look, panels, app.desk.tab).draw(app, height - app.look.m.row - 8.0F);
}

constexpr float kEdge = 10.0F;         // width of a panel's drag strip
constexpr float kLeastPanel = 240.0F;  // width
constexpr float kLeastView = 320.0F;

// The strip at a panel's inner edge: a drag changes the width; a click folds or unfolds the panel.
// @param outward +1 if the panel is to the right of the strip, -1 if to the left
void edge(App& app, const char* id, PanelSide& side, float& dragged, const ViewRect& strip,
          float width, float most, float outward) {
  const Theme& t = *app.look.theme;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  if (begin_panel(id, strip, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar)) {
    ImGui::InvisibleButton("edge", {strip.width, strip.height});
    const bool moved = ImGui::IsMouseDragPastThreshold(ImGuiMouseButton_Left, 3.0F);
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive() && moved && side.open) {
      dragged = std::clamp(width - outward * ImGui::GetIO().MouseDelta.x, kLeastPanel, most);
    }
    if (ImGui::IsItemDeactivated() && !moved) side.open = !side.open;
    const ImVec2 c(strip.x + 0.5F * strip.width, strip.y + 0.5F * strip.height);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({c.x - 2.0F, c.y - 20.0F}, {c.x + 2.0F, c.y + 20.0F},
                       hot ? t.accent_hover : fade(t.faint, 0.7F), 2.0F);
    tooltip(app.look, "", side.open ? "Drag: width. Click: hide" : "Click: show");
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

// As dragged, else as it suits.
float width_of(float dragged, float suits, float most) {
  return dragged > 0.0F ? std::clamp(dragged, kLeastPanel, std::max(kLeastPanel, most)) : suits;
}

// A folded panel leaves only the strip that unfolds it.
void desktop_panels(App& app, const ViewRect& space) {
  const bool is_text = app.desk.tab == Tab::kText;
  const bool wide = space.width >= 1476.0F;
  const float most = 0.5F * (space.width - kLeastView);
  PanelSide& left = app.desk.left;
  PanelSide& right = app.desk.right;
  float& right_dragged = is_text ? app.desk.text_width : right.width;
  const float right_suits = is_text ? std::clamp(std::round(0.36F * space.width), 400.0F, 640.0F)
                                    : std::clamp(std::round(0.235F * space.width), 288.0F, 460.0F);
  const float left_width = width_of(left.width, wide ? 300.0F : 276.0F, most);
  const float right_width = width_of(right_dragged, right_suits, most);
  const float left_edge = left.open ? space.x + left_width : space.x - app.look.m.margin;
  const float right_edge =
      right.open ? space.x + space.width - right_width : space.x + space.width + app.look.m.margin;
  app.view_rect = {left_edge, 0.0F, right_edge - left_edge, space.y + space.height + space.y};
  if (left.open) {
    // As tall as its contents.
    ImGui::SetNextWindowPos({space.x, space.y});
    ImGui::SetNextWindowSizeConstraints({left_width, 0.0F}, {left_width, space.height});
    if (ImGui::Begin("##controls", nullptr, kPlaced | ImGuiWindowFlags_AlwaysAutoResize)) {
      controls(app.look, app, app.desk, app);
      scroll_by_drag();
    }
    ImGui::End();
  }
  if (right.open) {
    if (begin_panel("##plots", {right_edge, space.y, right_width, space.height})) {
      const float height = space.height - 2.0F * app.look.m.pad;
      if (is_text) {
        scene_text_panel(app.look, app, app.desk, height);
      } else if (app.desk.tab == Tab::kModel) {
        model_panel(app.look, app, app.desk);
      } else {
        instruments(app, height);
        scroll_by_drag();
      }
    }
    ImGui::End();
  }
  const float y = space.y + 0.5F * space.height - 60.0F;
  edge(app, "##left_edge", left, left.width, {left_edge, y, kEdge, 120.0F}, left_width, most,
       -1.0F);
  edge(app, "##right_edge", right, right_dragged, {right_edge - kEdge, y, kEdge, 120.0F},
       right_width, most, 1.0F);
}

void desktop(App& app, ImVec2 display) {
  const float margin = app.look.m.margin;
  const ViewRect bar{margin, display.y - margin - kBarHeight, display.x - 2.0F * margin,
                     kBarHeight};
  app.view_rect = {0.0F, 0.0F, display.x, bar.y};
  if (app.desk.panels) {
    desktop_panels(app, {margin, margin, display.x - 2.0F * margin, bar.y - 2.0F * margin});
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F, 12.0F});
  if (begin_panel("##transport", bar, ImGuiWindowFlags_NoScrollbar)) transport(app, false);
  ImGui::End();
  ImGui::PopStyleVar();
}

// View on top (on the left in landscape), controls in tabs below (on the right).
void phone(App& app, ImVec2 display) {
  const bool lying = display.x > display.y;
  const float side = lying ? std::min(392.0F, 0.5F * display.x) : display.x;
  // A tour card takes room from both; if its text is in the page, plots stay visible.
  const bool guided = app.desk.tour >= 0 && app.desk.tour_in_page;
  const float share = app.desk.tour < 0 ? 0.44F : guided ? 0.48F : 0.52F;
  const float top = lying ? 0.0F : std::round(share * display.y);
  app.view_rect = lying ? ViewRect{0.0F, 0.0F, display.x - side, display.y}
                        : ViewRect{0.0F, 0.0F, display.x, top};
  if (!app.desk.panels) {
    const float bar = 92.0F;
    app.view_rect = {0.0F, 0.0F, display.x, display.y - bar};
  }
  const ViewRect panel = app.desk.panels ? ViewRect{display.x - side, top, side, display.y - top}
                                         : ViewRect{0.0F, app.view_rect.height, display.x,
                                                    display.y - app.view_rect.height};
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F, 12.0F});
  if (begin_panel("##phone", panel,
                  ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse)) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    transport(app, true);
    if (app.desk.panels) {
      ImGui::SetCursorScreenPos({origin.x, origin.y + 76.0F});
      if (app.desk.tab >= Tab::kText) {
        if (app.desk.tab == Tab::kText) {
          scene_text_panel(app.look, app, app.desk, ImGui::GetContentRegionAvail().y);
        } else {
          model_panel(app.look, app, app.desk);
        }
        ImGui::End();
        ImGui::PopStyleVar(3);
        return;
      }
      const auto panels = panels_of(app.desk);
      // The tour's text replaces the tabs and links to the panels itself.
      const Panel& open =
          guided ? panel_of(panels, app.desk.tab) : choose_panel(app.look, panels, app.desk.tab);
      ImGui::Dummy({1.0F, 0.0F});
      if (ImGui::BeginChild("content", {0, 0})) {
        if (open.tab == Tab::kPlots) {  // alone: there is little room
          plots(app.look, app, app.desk, app, ImGui::GetContentRegionAvail().y - 4.0F);
        } else {
          open.draw(app, 0.0F);
        }
        if (open.tab == Tab::kWhy && app.desk.level == DeskLevel::kLab) {
          space(app.look.m.section);
          timing(app.look, app.session, false);
        }
        scroll_by_drag();
      }
      ImGui::EndChild();
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

// The application's notice, above the bar.
void notice(App& app) {
  if (app.notice.text.empty() || app.notice.left <= 0.0) return;
  const Look& look = app.look;
  const ViewRect& v = app.view_rect;
  const std::string text = fitted(look.fonts.regular, app.notice.text, v.width - 64.0F);
  const ImVec2 size = text_size(look.fonts.regular, text);
  const ImVec2 at(v.x + 0.5F * (v.width - size.x), v.y + v.height - 68.0F);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({at.x - 14.0F, at.y - 8.0F}, {at.x + size.x + 14.0F, at.y + size.y + 8.0F},
                     look.theme->raised, look.m.panel_radius);
  draw_text(draw, look.fonts.regular, at, look.theme->text, text);
}

bool is_small(ImVec2 display) { return display.x < 900.0F || display.y < 480.0F; }

}  // namespace

void draw_window(App& app) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const bool small = is_small(display);
  if (app.introduction.open()) {
    introduction(app);
    return trouble_card(app.look, app, app);
  }
  view_input(app, app.desk, app);
  if (small) {
    phone(app, display);
  } else {
    desktop(app, display);
  }
  app.view_rect.height -= app.desk.tour_height;
  // "My model" shows it already.
  if (app.desk.tab != Tab::kModel) selection_card(app.look, app.session, app.desk, app, small);
  std::optional<TourWords> words;
  if (app.desk.tour >= 0 && !app.desk.tour_in_page) {
    words = tour_words(app, static_cast<std::size_t>(app.desk.tour), app.tour.loop());
  }
  if (app.desk.cards || words) tour(app.look, app.desk, app, words ? &*words : nullptr);
  if (!small) accuracy_card(app.look, app, app.desk, app);
  if (app.desk.cards) failure_card(app.look, app, app.desk, app);
  help_card(app.look, app, app.desk, app);
  file_card(app.look, app, app, app.browser);
  heavy_card(app.look, app, app);
  long_frame_card(app.look, app, app.desk, app);
  trouble_card(app.look, app, app);
}

void draw_over_picture(App& app) {
  if (app.introduction.open()) {
    first_tear(app.look, app, app);
    return notice(app);
  }
  const bool small = is_small(ImGui::GetIO().DisplaySize);
  annotations(app.look, app, app.desk, app);
  body_labels(app.look, app, app.desk, app);
  joint_rings(app.look, app, app.desk, app);
  failure_rings(app.look, app, app);
  caption(app.look, app.session, app.desk, app, small);
  compare_legend(app.look, app.session, app.compare, app.desk, app);
  if (!small) tint_scale(app.look, app.session, app.compare, app.desk, app);
  notice(app);
}

}  // namespace substep::ui
