#pragma once
// Where the controls of the last frame lie, by what is written on them: for those who work the
// window by program, tests above all.

#include <imgui.h>

#include <string>
#include <vector>

namespace substep::ui {

struct Handle {
  std::string group;  // of a row of choices, or ""
  std::string label;
  ImVec2 min;  // in the interface's own pixels, see Desk::scale
  ImVec2 max;
};

/// Those of the frame that was drawn last, in the order in which they came.
const std::vector<Handle>& handles();
void forget_handles();  ///< at the start of a frame
/// The part of a control that can be seen; nothing where none of it can.
void mark(const char* label, ImVec2 min, ImVec2 max, const char* group = "");

}  // namespace substep::ui
