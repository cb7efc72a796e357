// The bar at the bottom: play, step, reset, speed; and the verdict.

#include <algorithm>
#include <cmath>
#include <string>

#include "app/app.hpp"
#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/io/experiment.hpp"

namespace substep::ui {
namespace {

const char* speed_name(double speed) {
  for (const Speed& s : kSpeeds) {
    if (std::abs(s.value - speed) < 1e-9) return s.name;
  }
  return "?";
}

void play_buttons(App& app, float height, float gap) {
  const Look& look = app.look;
  const bool playing = app.session.playing();
  if (button(look, "play", playing ? Icon::kPause : Icon::kPlay, "", ButtonKind::kPrimary, 48.0F,
             height, playing ? "Pause (Space)" : "Play (Space)")) {
    app.session.toggle();
  }
  const auto add = [&](const char* id, Icon icon, const char* tip) {
    ImGui::SameLine(0.0F, gap);
    return button(look, id, icon, "", ButtonKind::kPlain, 36.0F, height, tip);
  };
  // Single frames and sub-steps are Lab controls; their keys always work.
  if (app.desk.level == DeskLevel::kLab) {
    if (add("step", Icon::kStep, "One frame (.), back with the comma key")) {
      app.session.request_step();
    }
    if (add("substep", Icon::kSubstep, "One sub-step (;): one pass of the loop of Algorithm 1")) {
      app.session.substep();
    }
  }
  if (add("reset", Icon::kReset, "Back to the start (R)")) app.reset();
  ImGui::SameLine(0.0F, gap);
  menu_button(look, "speed", speed_name(app.session.speed()), 84.0F, height,
              "Speed of the simulation relative to real time ([ and ])", [&] {
                for (const Speed& s : kSpeeds) {
                  if (menu_item(look, s.name, "", s.value == app.session.speed())) {
                    app.session.set_speed(s.value);
                  }
                }
              });
}

constexpr float kChipFrame = 40.0F;  // width of a verdict's icon and round ends

// Omits the reason if there is no room for it; it is in the tooltip.
std::string verdict_text(const App& app, float room) {
  const Look& look = app.look;
  if (!app.session.judged()) return "Ready";
  std::string text = verdict_words(app.session.verdict().text());
  room -= kChipFrame;
  if (text_size(look.fonts.medium, text).x <= room) return text;
  return fitted(look.fonts.medium, text.substr(0, text.find(": ")), room);
}

// Verdict with an icon: a tick, circle or cross, so that it does not depend on colour alone.
// @return its width
float verdict_chip(App& app, ImVec2 at, float height, const std::string& text) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const Verdict& verdict = app.session.verdict();
  const bool ready = !app.session.judged();
  const bool disturbed = verdict.holds() && verdict.disturbed();
  const ImU32 color = ready ? t.dim : disturbed ? t.amber : verdict.holds() ? t.teal : t.orange;
  const ImVec2 size = text_size(look.fonts.medium, text);
  const float width = size.x + kChipFrame;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float top = at.y + 0.5F * (height - 28.0F);
  draw.AddRectFilled({at.x, top}, {at.x + width, top + 28.0F}, fade(color, t.dark ? 0.14F : 0.1F),
                     14.0F);
  const ImVec2 sign(at.x + 17.0F, top + 14.0F);
  if (disturbed || ready) {
    draw.AddCircle(sign, 5.0F, color, 0, 2.0F);
  } else {
    draw_icon(draw, verdict.holds() ? Icon::kCheck : Icon::kCross, sign, 16.0F, color);
  }
  draw_text(look.fonts.medium, {at.x + 28.0F, top + 0.5F * (28.0F - size.y)}, color, text);
  ImGui::SetCursorScreenPos({at.x, top});
  ImGui::InvisibleButton("verdict", {width, 28.0F});
  tooltip(look, ready ? text : verdict_words(verdict.text()),
          ready       ? "The run has not started. Each frame is judged after it is computed."
          : disturbed ? "A body was pulled or a ball thrown: this is no longer the scene's own "
                        "run. Only torn joints and numbers that are not finite still count as "
                        "failures. A reset restores the scene."
                      : "Judged by the criteria in the scene's file: the largest joint gap, energy "
                        "gained, a body displaced, numbers that are not finite.");
  return width;
}

// Text right-aligned at `right`. @return its left end
float status(const Look& look, float right, ImVec2 bar, float height, const std::string& text,
             float least_width, const char* tip) {
  const ImVec2 size = text_size(look.fonts.small, text);
  const float width = std::max(size.x, least_width);
  const ImVec2 at(right - width, bar.y + 0.5F * (height - size.y));
  draw_text(look.fonts.small, at, look.theme->dim, text);
  ImGui::SetCursorScreenPos(at);
  ImGui::PushID(tip);
  ImGui::InvisibleButton("status", {width, size.y});
  ImGui::PopID();
  tooltip(look, "", tip);
  return right - width - 16.0F;
}

// As many as there is room for, the most useful on the right.
float icon_buttons(App& app, float left, float right, ImVec2 bar, float height) {
  const Look& look = app.look;
  const auto place = [&] {  // whether there is room
    if (right - height < left) return false;
    right -= height;
    ImGui::SetCursorScreenPos({right, bar.y});
    return true;
  };
  const auto add = [&](const char* id, Icon icon, const char* tip) {
    return place() && button(look, id, icon, "", ButtonKind::kGhost, height, height, tip);
  };
  if (add("help", Icon::kHelp, "About, keys and gestures (?)")) app.desk.help = !app.desk.help;
  if (place()) share_menu(look, app, app.desk, app, height);
  if (add("theme", app.desk.dark ? Icon::kSun : Icon::kMoon, "Light or dark (T)")) {
    app.desk.dark = !app.desk.dark;
  }
  if (app.desk.level == DeskLevel::kExplore) return right - 8.0F;
  if (add("panels", Icon::kPanels, "Panels on or off (H)")) app.desk.panels = !app.desk.panels;
  if (add("ball", Icon::kBall, "Throw a ball (B throws it at the pointer)")) throw_ball(app, app);
  if (add("frame", Icon::kFrame, "Show everything (F)")) app.view.frame_all(app.session);
  return right - 8.0F;
}

std::string time_text(const App& app) {
  // Within a frame the time advances by fractions of a millisecond.
  return fixed(app.session.state().time, app.session.substeps_left() > 0 ? 4 : 2) + " s";
}

// Two rows: buttons, then the timeline between verdict and time.
void phone_transport(App& app, ImVec2 bar, float width, float height) {
  const Look& look = app.look;
  play_buttons(app, height, 6.0F);
  icon_buttons(app, ImGui::GetItemRectMax().x + 2.0F, bar.x + width, bar, height);
  const float y = bar.y + height + 8.0F;
  const std::string time = time_text(app);
  const float time_width = text_size(look.fonts.medium, time).x;
  draw_text(look.fonts.medium, {bar.x + width - time_width, y + 4.0F}, look.theme->text, time);
  constexpr float kLeastTrack = 96.0F;
  const std::string verdict = verdict_text(app, width - time_width - kLeastTrack - 20.0F);
  const float chip = verdict_chip(app, {bar.x, y - 2.0F}, 28.0F, verdict);
  scrubber(app.look, app.session, {bar.x + chip + 8.0F, y - 2.0F},
           width - chip - time_width - 20.0F, 28.0F);
}

}  // namespace

void transport(App& app, bool phone) {
  const Look& look = app.look;
  constexpr float kHeight = 32.0F;
  constexpr float kGap = 16.0F;
  const ImVec2 bar = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  if (phone) {
    phone_transport(app, bar, width, kHeight);
    return;
  }
  play_buttons(app, kHeight, 8.0F);
  const float after_buttons = ImGui::GetItemRectMax().x + kGap;
  float right = icon_buttons(app, after_buttons, bar.x + width, bar, kHeight);
  // A paused run is drawn only on changes: a rate would be meaningless.
  if (app.session.playing()) {
    const std::string fps = fixed(1.0 / std::max(1e-3, app.frame_time), 0) + " fps";
    right = status(look, right, bar, kHeight, fps, 40.0F, "Pictures drawn per second");
  }
  if (app.session.playing() && app.session.pace() < 0.9) {
    right = status(look, right, bar, kHeight, fixed(100.0 * app.session.pace(), 0) + " % speed",
                   0.0F, "The simulation is slower than the selected speed");
  }
  if (app.desk.level == DeskLevel::kLab && right - after_buttons > 560.0F) {
    // While the run plays it would change with every frame; its place stays.
    const std::string hash = "hash " + hex_text(app.session.hash());
    right = status(look, right, bar, kHeight, app.session.playing() ? "hash when paused" : hash,
                   text_size(look.fonts.small, hash).x,
                   "Hash of the state: the same on every machine for the same experiment");
  }

  // From the right: verdict, time; the timeline takes the rest.
  const float room = right - after_buttons;
  const float chip_room = std::clamp(0.45F * room, 100.0F, 300.0F);
  const std::string verdict = verdict_text(app, chip_room);
  const float chip = text_size(look.fonts.medium, verdict).x + kChipFrame;
  verdict_chip(app, {right - chip, bar.y}, kHeight, verdict);
  const std::string time = time_text(app);
  const ImVec2 time_size = text_size(look.fonts.medium, time);
  const float time_width = std::max(64.0F, time_size.x);
  const float time_right = right - chip - kGap;
  draw_text(look.fonts.medium, {time_right - time_size.x, bar.y + 0.5F * (kHeight - time_size.y)},
            look.theme->text, time);
  const float track = time_right - time_width - 8.0F - after_buttons;
  if (track > 48.0F) scrubber(app.look, app.session, {after_buttons, bar.y}, track, kHeight);
}

}  // namespace substep::ui
