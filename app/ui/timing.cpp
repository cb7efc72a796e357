// The time of a frame by stage, as a bar with labels.

#include "app/ui/timing.hpp"

#include <algorithm>
#include <string>

#include "app/text/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kNameRow = 17.0F;
constexpr float kListRow = 20.0F;

// Coloured names, in as many lines as required. @param draw null: only measures
// @return lines
int draw_names(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width,
               ImDrawList* draw) {
  float x = at.x;
  int lines = 1;
  for (const Stage& stage : list) {
    const float wide = 12.0F + text_size(look.fonts.small, stage.name).x;
    if (x > at.x && x + wide > at.x + width) {
      x = at.x;
      at.y += kNameRow;
      ++lines;
    }
    if (draw != nullptr) {
      draw->AddRectFilled({x, at.y + 4.0F}, {x + 8.0F, at.y + 12.0F}, stage.color, 2.0F);
      draw_text(look.fonts.small, {x + 12.0F, at.y}, look.theme->dim, stage.name);
    }
    x += wide + 12.0F;
  }
  return lines;
}

}  // namespace

std::vector<Stage> stages(const Theme& t, const Effects& effects, const StageTimes& times) {
  std::vector<Stage> list{{"solve", times.solve, t.blue, Channel::kTimeSolve}};
  if (effects.joints) list.push_back({"joints", times.joints, t.teal, Channel::kTimeJoints});
  if (effects.contact) list.push_back({"contact", times.contact, t.amber, Channel::kTimeContact});
  if (effects.friction)
    list.push_back({"friction", times.friction, t.orange, Channel::kTimeFriction});
  list.push_back({"stiffness", times.stiffness, t.purple, Channel::kTimeStiffness});
  double known = 0.0;
  for (const Stage& stage : list) known += stage.seconds;
  list.push_back({"rest", std::max(0.0, times.total - known), t.grey, Channel::kTime});
  return list;
}

std::vector<Stage> stages(const Look& look, const Session& session) {
  return stages(*look.theme, session.scene().effects, session.times());
}

void stage_bar(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + width, at.y + kStageBar}, look.theme->well, 3.0F);
  double total = 0.0;
  for (const Stage& stage : list) total += stage.seconds;
  if (!(total > 0.0)) return;
  float x = at.x;
  for (const Stage& stage : list) {
    const float w = static_cast<float>(stage.seconds / total) * width;
    if (w >= 1.0F) {
      draw.AddRectFilled({x, at.y}, {x + w - 1.0F, at.y + kStageBar}, stage.color, 2.0F);
    }
    x += w;
  }
}

void stage_list(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float half = 0.5F * (width + 24.0F);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const float left = at.x + half * static_cast<float>(i % 2);
    const float y = at.y + kListRow * static_cast<float>(i / 2);
    draw.AddRectFilled({left, y + 4.0F}, {left + 8.0F, y + 12.0F}, list[i].color, 2.0F);
    draw_text(look.fonts.small, {left + 12.0F, y}, look.theme->dim, list[i].name);
    draw_text_before(look.fonts.small, {left + half - 24.0F, y}, look.theme->text,
                     duration(list[i].seconds));
  }
}

float stage_list_height(const std::vector<Stage>& list) {
  return kListRow * static_cast<float>((list.size() + 1) / 2);
}

float timing_height(const Look& look, const Session& session, bool brief) {
  const std::vector<Stage> list = stages(look, session);
  if (brief) {
    const int lines =
        draw_names(look, list, {0.0F, 0.0F}, ImGui::GetContentRegionAvail().x, nullptr);
    return kHeading + 18.0F + kNameRow * static_cast<float>(lines);
  }
  return kHeading + 20.0F + stage_list_height(list);
}

void timing(const Look& look, const Session& session, bool brief) {
  const std::vector<Stage> list = stages(look, session);
  const double total = session.times().total;
  section(look, "Time per frame", total > 0.0 ? duration(total) : "");
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  stage_bar(look, list, origin, width);
  if (brief) {
    draw_names(look, list, {origin.x, origin.y + 18.0F}, width, ImGui::GetWindowDrawList());
  } else if (total > 0.0) {
    stage_list(look, list, {origin.x, origin.y + 20.0F}, width);
  }
  ImGui::Dummy({width, timing_height(look, session, brief) - kHeading});
  std::string tip =
      "Wall time of the simulation by stage, smoothed over half a second. Stages that the scene "
      "does not need are not executed.";
  for (const Stage& stage : list) {
    if (!brief || !(total > 0.0)) break;
    tip.append("\n").append(stage.name).append("  ").append(duration(stage.seconds));
  }
  tooltip(look, "Time per frame", tip);
}

}  // namespace substep::ui
