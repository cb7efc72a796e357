#pragma once

#include <imgui.h>

#include <vector>

#include "app/app.hpp"

namespace substep::ui {

inline constexpr float kHeading = 24.0F;  // a section's heading with the gap below it

/// A part of a sub-step's work, as it is drawn.
struct Stage {
  const char* name;
  double seconds;  // a frame, smoothed
  ImU32 color;
  Channel channel;
};
/// Those that the scene calls for, and the rest.
std::vector<Stage> stages(const App& app);

}  // namespace substep::ui
