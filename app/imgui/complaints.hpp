#pragma once
// Dear ImGui's user configuration: what it finds wrong with how it is called is told on the error
// output and counted, in every build. Nobody's run ends by it, and tests see it.

namespace substep::imgui {

void complain(const char* broken, const char* file, int line);
/// How often, since the program began.
int complaints();

}  // namespace substep::imgui

#define IM_ASSERT(holds) \
  ((holds) ? static_cast<void>(0) : substep::imgui::complain(#holds, __FILE__, __LINE__))
