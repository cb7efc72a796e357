#pragma once

#include <imgui.h>

#include <vector>

#include "app/ui/handles.hpp"

namespace substep::ui {

/// Owns the Dear ImGui context; create it before the renderer.
class Context {
 public:
  Context() : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.UserData = &handles_;
    io.IniFilename = nullptr;  // no ini file
    io.LogFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
  }
  ~Context() { ImGui::DestroyContext(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  std::vector<Handle> handles_;  // see handles.hpp
  ImGuiContext* context_;
};

}  // namespace substep::ui
