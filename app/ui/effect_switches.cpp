// The effects of the scene: live switches, and a table of their rows and times. A disabled effect
// has no stage.

#include <algorithm>
#include <array>
#include <string>

#include "app/text/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/effects.hpp"

namespace substep::ui {
namespace {

constexpr float kTimeColumn = 64.0F;

/// The rows of an effect in a frame's report, and the time to build them.
struct EffectRows {
  bool Effects::*effect;
  int FrameReport::*count;
  double StageTimes::*seconds;
};
constexpr EffectRows kRows[] = {
    {&Effects::joints, &FrameReport::joint_rows, &StageTimes::joints},
    {&Effects::contact, &FrameReport::contact_rows, &StageTimes::contact},
    {&Effects::friction, &FrameReport::friction_rows, &StageTimes::friction}};

/// Null for an effect without rows of its own.
const EffectRows* rows_of(const EffectEntry& effect) {
  for (const EffectRows& rows : kRows) {
    if (rows.effect == effect.member) return &rows;
  }
  return nullptr;
}

/// Right-aligned in the two columns at the end of a line.
void columns(const Look& look, ImVec2 at, float width, ImU32 color, const std::string& rows,
             const std::string& time) {
  const float right = at.x + width;
  draw_text_before(look.fonts.small, {right - kTimeColumn, at.y}, color, rows);
  draw_text_before(look.fonts.small, {right, at.y}, color, time);
}

const EffectCost* cost_of(const CostBreakdown* costs, std::string_view effect) {
  if (costs == nullptr) return nullptr;
  const auto found = std::find_if(costs->effects.begin(), costs->effects.end(),
                                  [&](const EffectCost& cost) { return cost.effect == effect; });
  return found == costs->effects.end() ? nullptr : &*found;
}

/// Cost of an effect: the full cost if measured, else the time of its own stage.
std::string time_text(const Session& session, const EffectRows* rows, const EffectCost* cost) {
  if (cost != nullptr) return duration(1e-3 * cost->ms);
  return rows != nullptr ? duration(session.times().*rows->seconds) : "–";
}

std::string tip_text(const EffectEntry& effect, const EffectCost* cost) {
  std::string tip = effect.about;
  if (cost != nullptr) {
    tip += "\nAdds " + duration(1e-3 * cost->ms) + " and " + short_number(cost->flops) +
           " solver operations per frame.";
  } else if (rows_of(effect) != nullptr) {
    tip += "\nThe time is that of building its rows; the time to solve them must be measured.";
  } else {
    tip += "\nIt has no stage of its own: its cost must be measured.";
  }
  return tip;
}

}  // namespace

void effect_switches(const Look& look, Session& session) {
  Effects effects = session.scene().effects;
  bool first = true;
  ImGui::PushID("effects");  // "joints" is also a display option
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {6.0F, 6.0F});
  for (const EffectEntry& effect : kEffects) {
    if (!(session.loaded().effects.*effect.member)) continue;
    const std::string tip = std::string(effect.about) + "\nOff until a reset.";
    toggle(look, effect.name.data(), effects.*effect.member, 0, first, tip);
    first = false;
  }
  ImGui::PopStyleVar();
  ImGui::PopID();
  if (effects != session.scene().effects) session.set_effects(effects);
}

void effect_table(const Look& look, Lab& lab) {
  const Theme& t = *look.theme;
  const Session& session = lab.session;
  const CostBreakdown* costs = lab.costs();
  const float width = ImGui::GetContentRegionAvail().x;
  columns(look, ImGui::GetCursorScreenPos(), width, t.dim, "rows", costs ? "adds" : "time");
  label(look.fonts.small, t.dim, "Effects");

  const float text = text_size(look.fonts.small, "0").y;
  for (const EffectEntry& effect : kEffects) {
    if (!(session.loaded().effects.*effect.member)) continue;
    const EffectCost* cost = cost_of(costs, effect.name);
    const EffectRows* rows = rows_of(effect);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool on = session.scene().effects.*effect.member;
    draw_text(look.fonts.small, at, on ? t.text : t.dim, effect.name.data());
    columns(look, at, width, on ? t.text : t.dim,
            on && rows != nullptr ? grouped(session.report().*rows->count) : "–",
            on ? time_text(session, rows, cost) : "–");
    ImGui::PushID(effect.name.data());
    ImGui::InvisibleButton("cost", {width, text});
    ImGui::PopID();
    tooltip(look, effect.name.data(), tip_text(effect, cost));
  }

  if (lab.accuracy.effects.running()) {
    if (progress(look, lab.accuracy.effects.progress(), "Keeps the measurements so far")) {
      lab.accuracy.effects.cancel();
    }
  } else if (costs == nullptr &&
             button(look, "measure effects", Icon::kPlay, "Measure cost per effect",
                    ButtonKind::kPlain, width, look.m.row,
                    "Repeats the run in the background, every frame once unchanged and once "
                    "without each effect: the difference is the cost of the effect, solving its "
                    "rows included.")) {
    lab.measure_costs();
  }
}

}  // namespace substep::ui
