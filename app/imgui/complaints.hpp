#pragma once
// Dear ImGui's user configuration: errors in how it is called are printed on the error
// output and counted, in every build. Nobody's run ends by it, and tests see it.

namespace substep::imgui {

void complain(const char* broken, const char* file, int line);
/// How often, since the program began.
int complaints();

}  // namespace substep::imgui

#define IM_ASSERT(holds) \
  ((holds) ? static_cast<void>(0) : substep::imgui::complain(#holds, __FILE__, __LINE__))
