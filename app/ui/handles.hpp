#pragma once
// Positions of the last frame's controls, by label: for automation, mainly tests.

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

namespace substep::ui {

struct Handle {
  std::string group;  // of a row of choices, or ""
  std::string label;
  ImVec2 min;  // in interface pixels, see Desk::scale
  ImVec2 max;
};

/// Handles of the last frame, in drawing order.
const std::vector<Handle>& handles();
void forget_handles();  ///< call at the start of a frame
/// Records the visible part of a control, if any.
void mark(std::string_view label, ImVec2 min, ImVec2 max, std::string_view group = "");
/// An invisible button with a handle. @return whether it was pressed
bool marked_button(const char* id, ImVec2 size, std::string_view label,
                   std::string_view group = "");

}  // namespace substep::ui
