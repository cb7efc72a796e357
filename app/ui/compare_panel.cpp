// "Compare": other methods beside the run, on the same scene and clock.

#include <algorithm>
#include <array>
#include <string>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/setting_fields.hpp"

namespace substep::ui {
namespace {

struct Comparison {
  const char* title;
  const char* note;
  const char* link;  // settings of the run, then the compared runs
};
constexpr std::array<Comparison, 4> kComparisons{
    {{"None, damping, adaptive", "which of them hold, and their cost",
      "mode=adaptive&compare=mode:none;mode:damping"},
     {"PGS and BPP", "an approximate and an exact solver",
      "mode=adaptive&solver=bpp&compare=solver:pgs"},
     {"Alpha 0.1 and 0.05", "√2 times the sub-steps: how much less error?",
      "mode=adaptive&alpha=0.1&compare=alpha:0.05"},
     {"Euler and leapfrog", "first and second order at the same cost",
      "mode=adaptive&integrator=euler&compare=integrator:leapfrog"}}};

struct Addition {
  const char* name;
  const char* key;  // of the setting that differs
  const char* value;
};
constexpr std::array<Addition, 8> kAdditions{{{"without sub-steps", "mode", "none"},
                                              {"constant N", "mode", "const"},
                                              {"damping", "mode", "damping"},
                                              {"adaptive", "mode", "adaptive"},
                                              {"capped, then damping", "mode", "capped"},
                                              {"PGS", "solver", "pgs"},
                                              {"BPP", "solver", "bpp"},
                                              {"leapfrog", "integrator", "leapfrog"}}};

std::string cost_text(const Cost& cost) {
  if (cost.frames == 0) return "no frame yet";
  return grouped(static_cast<double>(cost.substeps)) + " sub-steps  ·  " +
         duration(cost.seconds / static_cast<double>(cost.frames)) + " per frame";
}

struct Line {
  std::string name;
  ImU32 color;
  const Verdict* verdict;
  bool judged;  // a frame was judged
  const Cost* cost;
};

// Two rows: name and verdict, then cost.
void draw_line(const Look& look, const Line& line) {
  const Theme& t = *look.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({at.x, at.y + 3.0F}, {at.x + 10.0F, at.y + 13.0F}, line.color, 3.0F);
  const ImU32 ink = !line.judged ? t.dim : line.verdict->holds() ? t.teal : t.orange;
  const float x =
      draw_text_before(look.fonts.small, {at.x + ImGui::GetContentRegionAvail().x, at.y + 1.0F},
                       ink, verdict_note(*line.verdict, line.judged));
  if (line.judged) {
    draw_icon(draw, line.verdict->holds() ? Icon::kCheck : Icon::kCross, {x - 10.0F, at.y + 8.0F},
              12.0F, ink);
  }
  draw_text(look.fonts.medium, {at.x + 18.0F, at.y}, t.text,
            fitted(look.fonts.medium, line.name, x - at.x - 44.0F));
  draw_text(look.fonts.small, {at.x + 18.0F, at.y + 18.0F}, t.dim, cost_text(*line.cost));
  ImGui::Dummy({1.0F, 36.0F});
}

std::string divergence_text(const Session& session, const Compare::Run& run) {
  const std::string threshold = fixed(100.0 * Compare::kThreshold, 0) + " cm";
  if (!run.divergence) return "Still within " + threshold + " of this run.";
  const std::string& body =
      session.scene().bodies[static_cast<std::size_t>(run.divergence->body)].name;
  return "Diverges from this run at " + fixed(run.divergence->time, 2) + " s: " + body +
         " is more than " + threshold + " away.";
}

// @return whether to remove the compared run
bool other(const Look& look, const Session& session, Compare& compare, Desk& desk, std::size_t i) {
  const Compare::Run& run = compare.runs()[i];
  const float row = look.m.row;
  const bool opened = desk.compare_open == static_cast<int>(i);
  draw_line(look, {overrides_title(run.overrides, session.settings()), compare_color(look, i),
                   &*run.verdict, session.judged(), &run.cost});
  label(look.fonts.small, look.theme->dim, divergence_text(session, run));
  if (button(look, "change", Icon::kNone, opened ? "Done" : "Change", ButtonKind::kPlain, 0.0F, row,
             "Any setting of this run only")) {
    desk.compare_open = opened ? -1 : static_cast<int>(i);
  }
  ImGui::SameLine(0.0F, 8.0F);
  const bool gone =
      button(look, "remove", Icon::kNone, "Remove", ButtonKind::kGhost, 0.0F, row, "");
  if (!gone && opened) {
    Settings s = Compare::settings_of(run.overrides, session.settings());
    const Settings before = s;
    space(look.m.section);
    method_controls(look, session.scene(), s, desk.more);
    if (s != before) compare.change(session, i, s);
  }
  return gone;
}

void presets(const Look& look, Desk& desk) {
  label(look.fonts.small, look.theme->dim,
        "Runs other methods with this one: the same scene, clock and start. They are shown as "
        "ghosts or side by side, and in the plots. Pulls and balls act on all of them.");
  space(look.m.section);
  for (const Comparison& preset : kComparisons) {
    if (button(look, preset.title, Icon::kNone, preset.title, ButtonKind::kPlain,
               ImGui::GetContentRegionAvail().x, look.m.row + 4.0F, "")) {
      desk.follow = preset.link;
    }
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 4.0F);
    label(look.fonts.small, look.theme->dim, preset.note);
    space(12.0F);
  }
}

void restart_buttons(const Look& look, Lab& lab) {
  const float half = 0.5F * (ImGui::GetContentRegionAvail().x - 8.0F);
  if (button(look, "start", Icon::kReset, "From start", ButtonKind::kPlain, half, look.m.row,
             "All of them from the scene's start (R)")) {
    lab.reset();
    lab.session.play();
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "now", Icon::kNone, "From now", ButtonKind::kPlain, half, look.m.row,
             "All of them from the current state of this run")) {
    lab.compare.restart(lab.session);
  }
}

void views_row(const Look& look, Desk& desk) {
  static constexpr std::array<Choice, 2> kViews{
      {{"Ghosts", "All in one view: this run as usual, the others in their colours (V)"},
       {"Side by side", "Each in its own view, from the same camera (V)"}}};
  int split = desk.split ? 1 : 0;
  segmented(look, "views", kViews, split, ImGui::GetContentRegionAvail().x);
  desk.split = split == 1;
}

}  // namespace

std::string run_title(const Session& session, const Compare& compare) {
  // Named by the differing settings.
  Overrides own;
  for (const Compare::Run& run : compare.runs()) {
    for (const Override& o : run.overrides) {
      const bool known = std::any_of(own.begin(), own.end(),
                                     [&](const auto& other) { return other.key == o.key; });
      const SettingField* field = find_setting(o.key);
      if (known || field == nullptr) continue;
      own.push_back({o.key, setting_text(*field, session.settings())});
    }
  }
  return own.empty() ? "this run" : overrides_title(own, session.settings()) + " (this run)";
}

void compare_menu(const Look& look, const Session& session, Compare& compare, const char* name,
                  float width) {
  menu_button(look, "add", name, width, look.m.row + 4.0F, "", [&] {
    for (const Addition& addition : kAdditions) {
      if (menu_item(look, addition.name))
        compare.add(session, {Override{addition.key, addition.value}});
    }
  });
}

void compare(const Look& look, Lab& lab, Desk& desk) {
  section(look, "Compare");
  const float width = ImGui::GetContentRegionAvail().x;
  if (!lab.compare.open()) {
    presets(look, desk);
    compare_menu(look, lab.session, lab.compare, "One of your own …", width);
    return;
  }
  restart_buttons(look, lab);
  views_row(look, desk);
  space(look.m.section);
  const Cost cost = lab.compare.cost(lab.session);
  draw_line(look, {run_title(lab.session, lab.compare), look.theme->blue, &lab.session.verdict(),
                   lab.session.judged(), &cost});
  std::optional<std::size_t> gone;
  for (std::size_t i = 0; i < lab.compare.runs().size(); ++i) {
    space(look.m.section);
    ImGui::PushID(static_cast<int>(i));
    if (other(look, lab.session, lab.compare, desk, i)) gone = i;
    ImGui::PopID();
  }
  space(look.m.section + 4.0F);
  if (lab.compare.runs().size() < kMostCompared)
    compare_menu(look, lab.session, lab.compare, "Add another …", width);
  if (button(look, "close", Icon::kNone, "End the comparison", ButtonKind::kGhost, width,
             look.m.row, "")) {
    lab.compare.close();
  }
  if (gone) {
    desk.compare_open = -1;
    lab.compare.remove(lab.session, *gone);
  }
}

}  // namespace substep::ui
