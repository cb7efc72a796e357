#pragma once
// The application in a test: a display of a given size, no window, no pixels.

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "app/app.hpp"
#include "app/imgui/complaints.hpp"
#include "app/ui/context.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/interface_scale.hpp"
#include "tests/app/ui/null_renderer.hpp"

namespace substep {

inline constexpr double kFrame = 1.0 / 60.0;

inline Library shipped() { return Library(std::string(SUBSTEP_SOURCE_DIR) + "/scenes"); }

inline std::shared_ptr<const Scene> shipped(const std::string& name) {
  auto scene = shipped().find(name);
  EXPECT_NE(scene, nullptr) << name;
  return scene;
}

/// The control of the last frame with this label, or null.
inline const ui::Handle* find_handle(std::string_view label) {
  const auto& all = ui::handles();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& h) { return h.label == label; });
  return found == all.end() ? nullptr : &*found;
}

class Headless {
 public:
  explicit Headless(float width = 1280.0F, float height = 720.0F, float ratio = 1.0F) {
    resize(width, height, ratio);
    auto null_renderer = std::make_unique<NullRenderer>();
    renderer = null_renderer.get();
    app = std::make_unique<App>(shipped(), std::move(null_renderer));
    frames(3);
  }
  ~Headless() {
    EXPECT_EQ(imgui::complaints(), complaints) << "Dear ImGui prints the cause to stderr";
  }
  Headless(const Headless&) = delete;
  Headless& operator=(const Headless&) = delete;

  void resize(float width, float height, float ratio) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {width, height};
    io.DisplayFramebufferScale = {ratio, ratio};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      ImGui::GetIO().DeltaTime = static_cast<float>(kFrame);
      frame(*app, kFrame);
    }
  }
  void click(float x, float y) {
    ImGuiIO& io = ImGui::GetIO();
    io.AddMousePosEvent(x, y);
    frames(1);
    io.AddMouseButtonEvent(0, true);
    frames(1);
    io.AddMouseButtonEvent(0, false);
    frames(2);
  }
  /// Clicks the control with this label.
  void press(std::string_view label) {
    const ui::Handle* handle = find_handle(label);
    ASSERT_NE(handle, nullptr) << label;
    const float s = ui::interface_scale(app->desk, ImGui::GetIO().DisplaySize);
    click(0.5F * s * (handle->min.x + handle->max.x), 0.5F * s * (handle->min.y + handle->max.y));
  }
  void press_key(ImGuiKey key, ImGuiKey modifier = ImGuiKey_None) {
    ImGuiIO& io = ImGui::GetIO();
    if (modifier != ImGuiKey_None) io.AddKeyEvent(modifier, true);
    io.AddKeyEvent(key, true);
    frames(1);
    io.AddKeyEvent(key, false);
    if (modifier != ImGuiKey_None) io.AddKeyEvent(modifier, false);
    frames(2);
  }
  void type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    frames(2);
  }

 private:
  ui::Context context_;

 public:
  NullRenderer* renderer = nullptr;
  std::unique_ptr<App> app;
  int complaints =
      imgui::complaints();  // Dear ImGui's errors, including those that a test causes on purpose
};

}  // namespace substep
