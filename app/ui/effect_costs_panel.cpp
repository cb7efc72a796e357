// "Where does the time go?": the stages of a frame, the cost of each effect, and the cost of
// choosing the number of sub-steps.

#include <algorithm>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/timing.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kPartRow = 22.0F;
constexpr float kPartNames = 66.0F;
constexpr float kTimes = 60.0F;
constexpr float kOperations = 64.0F;

/// A part of a frame and its cost; negative if it saves work.
struct CostRow {
  std::string name;
  double seconds = 0.0;  // per frame
  double flops = 0.0;    // per frame
  ImU32 color = 0;
  std::string tip;
};

std::vector<CostRow> parts_of(const Theme& t, const CostBreakdown& costs) {
  const Work& work = costs.run.work;
  const auto frames = static_cast<double>(std::max<std::int64_t>(1, work.frames));
  std::vector<CostRow> parts;
  for (const EffectCost& cost : costs.effects) {
    CostRow part{std::string(cost.effect), 1e-3 * cost.ms, cost.flops, t.blue, ""};
    part.tip =
        "The cost of a frame minus that of the same frame without this effect, from the same state "
        "with the same number of sub-steps.";
    if (part.seconds < 0.0) part.tip += " It saves more than it costs.";
    if (cost.row_updates > 0.0) {
      part.tip += "\nRow updates of PGS per frame: " + short_number(cost.row_updates) + ".";
    }
    parts.push_back(std::move(part));
  }
  if (work.criterion.evaluations > 0) {
    const auto flops = static_cast<double>(work.criterion.flops);
    parts.push_back({"criterion", costs.run.timing.stages.stiffness / frames, flops / frames,
                     t.purple,
                     "K, its column norms and r (Eqs. 1, 4, 9): " +
                         grouped(static_cast<double>(work.criterion.evaluations)) +
                         " evaluations in " + grouped(frames) + " frames."});
  }
  return parts;
}

/// Bars on both sides of zero, with times and operations on the right.
void draw_parts(const Look& look, const std::vector<CostRow>& parts) {
  const Theme& t = *look.theme;
  const float width = ImGui::GetContentRegionAvail().x;
  const float room = width - kPartNames - kTimes - kOperations - 8.0F;
  double low = 0.0;
  double high = 0.0;
  for (const CostRow& part : parts) {
    low = std::min(low, part.seconds);
    high = std::max(high, part.seconds);
  }
  const double scale = high > low ? static_cast<double>(room) / (high - low) : 0.0;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (const CostRow& part : parts) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    marked_button(part.name.c_str(), {width, kPartRow}, part.name, "effect costs");
    tooltip(look, part.name, part.tip);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y);
    const float zero = at.x + kPartNames - static_cast<float>(low * scale);
    const float end = zero + static_cast<float>(part.seconds * scale);
    draw_text(look.fonts.small, {at.x, at.y + 3.0F}, t.dim,
              fitted(look.fonts.small, part.name, kPartNames - 6.0F));
    draw.AddRectFilled({std::min(zero, end), at.y + 5.0F},
                       {std::max({zero, end, std::min(zero, end) + 1.0F}), at.y + kPartRow - 5.0F},
                       part.color, 2.0F);
    const ImVec2 right(at.x + width, at.y + 3.0F);
    draw_text_before(look.fonts.small, {right.x - kOperations, right.y}, t.text,
                     duration(part.seconds));
    draw_text_before(look.fonts.small, right, t.dim, short_number(part.flops));
  }
  space(12.0F);
}

void stages_of_run(const Look& look, const Effects& effects, const CostBreakdown& costs) {
  StageTimes times = costs.run.timing.stages;
  const double frames = static_cast<double>(costs.run.work.frames);
  for (double StageTimes::*part :
       {&StageTimes::joints, &StageTimes::contact, &StageTimes::friction, &StageTimes::solve,
        &StageTimes::stiffness, &StageTimes::total}) {
    times.*part /= frames;
  }
  const std::vector<Stage> list = stages(*look.theme, effects, times);
  section(look, "Stages of a frame", duration(times.total));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  stage_bar(look, list, at, width);
  stage_list(look, list, {at.x, at.y + kStageBar + 8.0F}, width);
  ImGui::Dummy({width, kStageBar + 8.0F + stage_list_height(list)});
  tooltip(look, "Stages of a frame",
          "Mean wall time of a frame on this machine. Stages that the scene does not need are not "
          "executed. Rows of all kinds are solved together.");
}

/// "75 of joints, 24 of contact, 48 of friction"
std::string rows_text(const Work& work) {
  std::string text;
  const auto add = [&](std::int64_t count, const char* kind) {
    if (count == 0) return;
    if (!text.empty()) text += ", ";
    text +=
        short_number(static_cast<double>(count) / static_cast<double>(work.solves)) + " of " + kind;
  };
  if (work.solves == 0) return text;
  add(work.rows.joint, "joints");
  add(work.rows.contact, "contact");
  add(work.rows.friction, "friction");
  return text;
}

std::string summary(const CostBreakdown& costs) {
  const Work& work = costs.run.work;
  std::string text =
      "Means of " + grouped(static_cast<double>(work.frames)) + " frames, " +
      short_number(static_cast<double>(work.substeps) / static_cast<double>(work.frames)) +
      " sub-steps each.";
  const std::string rows = rows_text(work);
  if (!rows.empty()) text += " Rows of a solve: " + rows + ".";
  if (work.criterion.evaluations > 0 && work.flops > 0) {
    text +=
        " The criterion takes " +
        fixed(100.0 * static_cast<double>(work.criterion.flops) / static_cast<double>(work.flops),
              1) +
        " % of the solver's operations.";
  }
  return text;
}

}  // namespace

void effect_costs(const Look& look, Lab& lab) {
  const Theme& t = *look.theme;
  EffectCosts& measured = lab.accuracy.effects;
  const CostBreakdown* costs = measured.breakdown();
  const bool of_this_run = lab.costs() != nullptr;
  if (measured.running()) {
    if (progress(look, measured.progress(), "Keeps the measurements so far")) measured.cancel();
  } else {
    if (costs == nullptr) {
      label(look.fonts.small, t.dim,
            "The time of a frame: its stages, the cost of each effect, and the cost of choosing "
            "the number of sub-steps, with the current settings.");
      space(8.0F);
    }
    if (button(look, "measure", Icon::kPlay,
               of_this_run        ? "Measure again"
               : costs == nullptr ? "Measure this run"
                                  : "Measure these settings",
               of_this_run ? ButtonKind::kPlain : ButtonKind::kPrimary,
               ImGui::GetContentRegionAvail().x, look.m.row + 4.0F,
               "Repeats the run in the background: every frame once unchanged and once without "
               "each effect")) {
      lab.measure_costs();
      costs = nullptr;
    }
  }
  if (costs == nullptr) return;
  space(8.0F);
  label(look.fonts.medium, t.text, measured.scene()->title);
  const Settings& settings = measured.experiment()->settings;
  label(look.fonts.small, t.dim, curve_style(t, settings).name() + ", " + parameter_text(settings));
  if (!costs->run.holds) label(look.fonts.small, t.orange, verdict_words(costs->run.verdict));
  space(look.m.section);
  stages_of_run(look, measured.scene()->effects, *costs);
  space(look.m.section);
  section(look, "Per effect", "time     operations", t.dim);
  draw_parts(look, parts_of(t, *costs));
  label(look.fonts.small, t.dim, summary(*costs));
}

}  // namespace substep::ui
