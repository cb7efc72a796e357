#include "app/ui/handles.hpp"

#include <imgui_internal.h>

namespace substep::ui {
namespace {

// Handles of the current context, see context.hpp.
std::vector<Handle>& list() { return *static_cast<std::vector<Handle>*>(ImGui::GetIO().UserData); }

}  // namespace

const std::vector<Handle>& handles() { return list(); }

void forget_handles() { list().clear(); }

void mark(const char* label, ImVec2 min, ImVec2 max, const char* group) {
  ImRect box(min, max);
  box.ClipWith(ImGui::GetCurrentWindow()->ClipRect);
  if (box.GetWidth() <= 0.0F || box.GetHeight() <= 0.0F) return;
  list().push_back({group, label, box.Min, box.Max});
}

}  // namespace substep::ui
