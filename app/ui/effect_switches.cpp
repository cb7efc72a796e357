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

/// Text of the tip, and the fields of a frame's report for each effect.
struct EffectFacts {
  const char* tip;
  int FrameReport::*rows;       // null: no rows of its own
  double StageTimes::*seconds;  // null: no stage of its own
};
constexpr std::array<EffectFacts, kEffectNames.size()> kFacts{
    {{"Weight: m g on every moving body.", nullptr, nullptr},
     {"The torque I ω × ω of bodies with unequal moments.", nullptr, nullptr},
     {"All joints. Off: bodies are not connected.", &FrameReport::joint_rows, &StageTimes::joints},
     {"Contacts. Off: bodies pass through each other.", &FrameReport::contact_rows,
      &StageTimes::contact},
     {"Coulomb friction in contacts, boxed: |λ t| ≤ μ λ n.", &FrameReport::friction_rows,
      &StageTimes::friction},
     {"Contacts that bounce (Newton's law).", nullptr, nullptr},
     {"Constant forces and torques of the scene on its bodies.", nullptr, nullptr}}};

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
std::string time_text(const Session& session, const EffectFacts& facts, const EffectCost* cost) {
  if (cost != nullptr) return duration(1e-3 * cost->ms);
  return facts.seconds != nullptr ? duration(session.times().*facts.seconds) : "–";
}

std::string tip_text(const EffectFacts& facts, const EffectCost* cost) {
  std::string tip = facts.tip;
  if (cost != nullptr) {
    tip += "\nAdds " + duration(1e-3 * cost->ms) + " and " + short_number(cost->flops) +
           " solver operations per frame.";
  } else if (facts.seconds != nullptr) {
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
  for (std::size_t i = 0; i < kEffectNames.size(); ++i) {
    const auto& [name, member] = kEffectNames[i];
    if (!(session.loaded().effects.*member)) continue;
    const std::string tip = std::string(kFacts[i].tip) + "\nOff until a reset.";
    toggle(look, name.data(), effects.*member, 0, first, tip);
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
  columns(look, ImGui::GetCursorScreenPos(), width, t.dim, "rows", costs ? "adds" : "builds in");
  label(look.fonts.small, t.dim, "Effects");

  const float text = text_size(look.fonts.small, "0").y;
  for (std::size_t i = 0; i < kEffectNames.size(); ++i) {
    const auto& [name, member] = kEffectNames[i];
    if (!(session.loaded().effects.*member)) continue;
    const EffectCost* cost = cost_of(costs, name);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool on = session.scene().effects.*member;
    draw_text(look.fonts.small, at, on ? t.text : t.dim, name.data());
    int FrameReport::*const rows = kFacts[i].rows;
    columns(look, at, width, on ? t.text : t.dim,
            on && rows != nullptr ? grouped(session.report().*rows) : "–",
            on ? time_text(session, kFacts[i], cost) : "–");
    ImGui::PushID(static_cast<int>(i));
    ImGui::InvisibleButton("cost", {width, text});
    ImGui::PopID();
    tooltip(look, name.data(), tip_text(kFacts[i], cost));
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
