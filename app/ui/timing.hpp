#pragma once

#include <imgui.h>

#include <vector>

#include "app/lab/session.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

inline constexpr float kHeading = 24.0F;  // a section's heading with the gap below it

/// A part of a sub-step's work, as it is drawn.
struct Stage {
  const char* name;
  double seconds;  // a frame
  ImU32 color;
  Channel channel;
};
/// Those that the scene calls for, and the rest.
std::vector<Stage> stages(const Theme& theme, const Effects& effects, const StageTimes& times);
/// Those of the run, smoothed.
std::vector<Stage> stages(const Look& look, const Session& session);

/// The stages side by side, as long as their shares of all.
void stage_bar(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width);
/// Their names and times, two to a row.
void stage_list(const Look& look, const std::vector<Stage>& list, ImVec2 at, float width);
float stage_list_height(const std::vector<Stage>& list);
inline constexpr float kStageBar = 12.0F;  // height

}  // namespace substep::ui
