#pragma once

#include <imgui.h>

#include <vector>

#include "app/lab/session.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

inline constexpr float kHeading = 24.0F;  // height of a section's heading including the gap below

/// A stage of a sub-step, as drawn.
struct Stage {
  const char* name;
  double seconds;  // per frame
  ImU32 color;
  Channel channel;
};
/// The stages that the scene uses, and the rest.
std::vector<Stage> stages(const Theme& theme, const Effects& effects, const StageTimes& times);
/// The smoothed stages of the session.
std::vector<Stage> stages(const Look& look, const Session& session);

/// The stages as one bar, with lengths proportional to their times.
void stage_bar(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width);
/// Names and times, two per row.
void stage_list(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width);
float stage_list_height(const std::vector<Stage>& list);
inline constexpr float kStageBar = 12.0F;  // height

}  // namespace substep::ui
