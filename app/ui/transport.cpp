// The bar at the bottom: play, step, reset, speed; and how the run stands.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

struct Speed {
  double value;
  const char* name;
};
constexpr std::array<Speed, 7> kSpeeds{{{0.0625, "1/16×"},
                                        {0.125, "1/8×"},
                                        {0.25, "1/4×"},
                                        {0.5, "1/2×"},
                                        {1.0, "1×"},
                                        {2.0, "2×"},
                                        {4.0, "4×"}}};

const char* speed_name(double speed) {
  for (const Speed& s : kSpeeds) {
    if (std::abs(s.value - speed) < 1e-9) return s.name;
  }
  return "?";
}

void play_buttons(App& app, float height) {
  const Look& look = app.look;
  const bool playing = app.session.playing();
  if (button(look, "play", playing ? Icon::kPause : Icon::kPlay, "", ButtonKind::kPrimary, 52.0F,
             height, playing ? "Pause (Space)" : "Play (Space)")) {
    app.session.toggle();
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "step", Icon::kStep, "", ButtonKind::kPlain, 40.0F, height, "One frame (.)")) {
    app.session.pause();
    app.session.step();
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "reset", Icon::kReset, "", ButtonKind::kPlain, 40.0F, height,
             "Back to the start (R)")) {
    app.reset();
  }
  ImGui::SameLine(0.0F, 8.0F);
  menu_button(look, "speed", speed_name(app.session.speed()), 76.0F, height,
              "Speed of the simulation against the clock ([ and ])", [&] {
                for (const Speed& s : kSpeeds) {
                  if (menu_item(look, s.name, "", s.value == app.session.speed())) {
                    app.session.set_speed(s.value);
                  }
                }
              });
}

// Verdict with its sign: a tick or a cross says it as well as the colour does.
void verdict_chip(App& app, ImVec2 at, float height, float room) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const Verdict& verdict = app.session.verdict();
  const ImU32 color = verdict.holds() ? t.teal : t.orange;
  const std::string text = fitted(look.fonts.medium, verdict.text(), room - 36.0F);
  const ImVec2 size = text_size(look.fonts.medium, text.c_str());
  const float width = size.x + 40.0F;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float top = at.y + 0.5F * (height - 28.0F);
  draw.AddRectFilled({at.x, top}, {at.x + width, top + 28.0F}, fade(color, t.dark ? 0.14F : 0.1F),
                     14.0F);
  draw_icon(draw, verdict.holds() ? Icon::kCheck : Icon::kCross, {at.x + 17.0F, top + 14.0F}, 16.0F,
            color);
  draw_text(draw, look.fonts.medium, {at.x + 28.0F, top + 0.5F * (28.0F - size.y)}, color,
            text.c_str());
  ImGui::SetCursorScreenPos({at.x, top});
  ImGui::InvisibleButton("verdict", {width, 28.0F});
  tooltip(look, verdict.text().c_str(),
          "Judged by the criteria in the scene's file: the largest joint gap, energy gained, "
          "a body displaced, numbers that are not finite.");
}

// Text right-aligned at `right`. @return where it starts
float status(const Look& look, float right, ImVec2 bar, float height, const std::string& text,
             float least_width, const char* tip) {
  const ImVec2 size = text_size(look.fonts.small, text.c_str());
  const float width = std::max(size.x, least_width);
  const ImVec2 at(right - width, bar.y + 0.5F * (height - size.y));
  draw_text(*ImGui::GetWindowDrawList(), look.fonts.small, at, look.theme->dim, text.c_str());
  ImGui::SetCursorScreenPos(at);
  ImGui::PushID(tip);
  ImGui::InvisibleButton("status", {width, size.y});
  ImGui::PopID();
  tooltip(look, "", tip);
  return right - width - 16.0F;
}

// As many as there is room for, the most useful at the right.
float icon_buttons(App& app, float left, float right, ImVec2 bar, float height) {
  const Look& look = app.look;
  const auto add = [&](const char* id, Icon icon, const char* tip) {
    if (right - height < left) return false;
    right -= height;
    ImGui::SetCursorScreenPos({right, bar.y});
    return button(look, id, icon, "", ButtonKind::kGhost, height, height, tip);
  };
  if (add("help", Icon::kHelp, "Keys and gestures (?)")) app.desk.help = !app.desk.help;
  if (add("theme", app.desk.dark ? Icon::kSun : Icon::kMoon, "Light or dark (T)")) {
    app.desk.dark = !app.desk.dark;
  }
  if (add("panels", Icon::kPanels, "Panels on or off (H)")) app.desk.panels = !app.desk.panels;
  if (add("frame", Icon::kFrame, "Show everything (F)")) app.view.frame_all(app.session);
  return right - 8.0F;
}

}  // namespace

void transport(App& app, bool phone) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  constexpr float kHeight = 32.0F;
  const ImVec2 bar = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();

  play_buttons(app, kHeight);
  const float after_buttons = ImGui::GetItemRectMax().x + 16.0F;
  const std::string time = fixed(app.session.state().time, 2) + " s";
  const ImVec2 time_size = text_size(look.fonts.medium, time.c_str());

  if (phone) {
    icon_buttons(app, after_buttons - 12.0F, bar.x + width, bar, kHeight);
    const float y = bar.y + kHeight + 8.0F;
    verdict_chip(app, {bar.x, y - 2.0F}, 28.0F, width - time_size.x - 16.0F);
    draw_text(draw, look.fonts.medium, {bar.x + width - time_size.x, y + 4.0F}, t.text,
              time.c_str());
    return;
  }
  const float time_width = std::max(64.0F, time_size.x);
  draw_text(draw, look.fonts.medium,
            {after_buttons + time_width - time_size.x, bar.y + 0.5F * (kHeight - time_size.y)},
            t.text, time.c_str());
  const float chip_x = after_buttons + time_width + 16.0F;

  float right = icon_buttons(app, after_buttons - 12.0F, bar.x + width, bar, kHeight);
  // A run that rests is drawn only when something changes: a rate would say nothing.
  if (app.session.playing()) {
    const std::string fps = fixed(1.0 / std::max(1e-3, app.frame_time), 0) + " fps";
    right = status(look, right, bar, kHeight, fps, 40.0F, "Pictures drawn a second");
  }
  if (app.session.playing() && app.session.pace() < 0.9) {
    right = status(look, right, bar, kHeight, fixed(100.0 * app.session.pace(), 0) + " % speed",
                   0.0F, "The simulation takes longer than the time it shows");
  }
  if (right - chip_x > 320.0F) {
    right = status(look, right, bar, kHeight, "hash " + hex(app.session.hash()), 0.0F,
                   "Hash of the state's bits: the same on every machine for the same experiment");
  }
  verdict_chip(app, {chip_x, bar.y}, kHeight, right - chip_x);
}

}  // namespace substep::ui
