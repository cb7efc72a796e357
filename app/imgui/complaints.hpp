#pragma once
// Dear ImGui's user configuration: failed assertions are printed to standard error and counted, in
// every build. They never end a run; tests check the count.

namespace substep::imgui {

void complain(const char* broken, const char* file, int line);
/// Number of failed assertions since the program began.
int complaints();

}  // namespace substep::imgui

#define IM_ASSERT(holds) \
  ((holds) ? static_cast<void>(0) : substep::imgui::complain(#holds, __FILE__, __LINE__))
