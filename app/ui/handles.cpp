#include "app/ui/handles.hpp"

#include <imgui_internal.h>

namespace substep::ui {
namespace {

// Handles of the current context, see context.hpp.
std::vector<Handle>& list() { return *static_cast<std::vector<Handle>*>(ImGui::GetIO().UserData); }

}  // namespace

const std::vector<Handle>& handles() { return list(); }

void forget_handles() { list().clear(); }

void mark(std::string_view label, ImVec2 min, ImVec2 max, std::string_view group) {
  ImRect box(min, max);
  box.ClipWith(ImGui::GetCurrentWindow()->ClipRect);
  if (box.GetWidth() <= 0.0F || box.GetHeight() <= 0.0F) return;
  list().push_back({std::string(group), std::string(label), box.Min, box.Max});
}

bool marked_button(const char* id, ImVec2 size, std::string_view label, std::string_view group) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(id, size);
  mark(label, at, at + size, group);
  return pressed;
}

}  // namespace substep::ui
