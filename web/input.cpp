// Page events, forwarded to the application by web/input.mjs.

#include <emscripten.h>
#include <imgui.h>

#include <array>
#include <cfloat>
#include <string_view>

#include "web/instance.hpp"

using substep::web::instance;

namespace {

struct NamedKey {
  std::string_view name;  // KeyboardEvent.key
  ImGuiKey key;
};
constexpr std::array<NamedKey, 20> kKeys{{{"Tab", ImGuiKey_Tab},
                                          {"ArrowLeft", ImGuiKey_LeftArrow},
                                          {"ArrowRight", ImGuiKey_RightArrow},
                                          {"ArrowUp", ImGuiKey_UpArrow},
                                          {"ArrowDown", ImGuiKey_DownArrow},
                                          {"PageUp", ImGuiKey_PageUp},
                                          {"PageDown", ImGuiKey_PageDown},
                                          {"Home", ImGuiKey_Home},
                                          {"End", ImGuiKey_End},
                                          {"Delete", ImGuiKey_Delete},
                                          {"Backspace", ImGuiKey_Backspace},
                                          {" ", ImGuiKey_Space},
                                          {"Enter", ImGuiKey_Enter},
                                          {"Escape", ImGuiKey_Escape},
                                          {"a", ImGuiKey_A},
                                          {"c", ImGuiKey_C},
                                          {"v", ImGuiKey_V},
                                          {"x", ImGuiKey_X},
                                          {"y", ImGuiKey_Y},
                                          {"z", ImGuiKey_Z}}};

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE void substep_pointer(float x, float y, int touch) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddMouseSourceEvent(touch != 0 ? ImGuiMouseSource_TouchScreen : ImGuiMouseSource_Mouse);
  io.AddMousePosEvent(x, y);
}

EMSCRIPTEN_KEEPALIVE void substep_pointer_gone() {
  ImGui::GetIO().AddMousePosEvent(-FLT_MAX, -FLT_MAX);
}

/// @param button 0 left, 1 right, 2 middle
EMSCRIPTEN_KEEPALIVE void substep_button(int button, int down, int touch) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddMouseSourceEvent(touch != 0 ? ImGuiMouseSource_TouchScreen : ImGuiMouseSource_Mouse);
  io.AddMouseButtonEvent(button, down != 0);
}

EMSCRIPTEN_KEEPALIVE void substep_wheel(float x, float y) {
  ImGui::GetIO().AddMouseWheelEvent(x, y);
}

/// 1 when a second finger touches: the press of the first one is then not a click. 0 when a new
/// first finger touches.
EMSCRIPTEN_KEEPALIVE void substep_pinching(int on) { instance->pinching = on != 0; }

/// A two-finger gesture on the picture.
EMSCRIPTEN_KEEPALIVE void substep_pinch(double factor, double dx, double dy) {
  instance->app->view.camera.zoom(factor);
  instance->app->view.camera.pan(dx, dy, instance->app->panes.front());
}

/// @return whether the application handles the key; the page must then ignore it
EMSCRIPTEN_KEEPALIVE int substep_key(const char* name, int down, int ctrl, int shift, int alt,
                                     int super) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddKeyEvent(ImGuiMod_Ctrl, ctrl != 0);
  io.AddKeyEvent(ImGuiMod_Shift, shift != 0);
  io.AddKeyEvent(ImGuiMod_Alt, alt != 0);
  io.AddKeyEvent(ImGuiMod_Super, super != 0);
  for (const NamedKey& key : kKeys) {
    if (key.name != name) continue;
    io.AddKeyEvent(key.key, down != 0);
    return 1;
  }
  return 0;
}

EMSCRIPTEN_KEEPALIVE void substep_text(const char* utf8) {
  ImGui::GetIO().AddInputCharactersUTF8(utf8);
}

/// Releases all keys and buttons when the page loses focus.
EMSCRIPTEN_KEEPALIVE void substep_focus(int focused) { ImGui::GetIO().AddFocusEvent(focused != 0); }

EMSCRIPTEN_KEEPALIVE void substep_reduced_motion(int on) {
  instance->app->desk.reduced_motion = on != 0;
}

}  // extern "C"
