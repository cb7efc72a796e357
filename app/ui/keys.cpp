#include "app/ui/keys.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/app.hpp"
#include "app/text/format.hpp"
#include "app/ui/model_actions.hpp"
#include "app/ui/panels.hpp"

namespace substep::ui {
namespace {

void change_speed(Session& session, int by) {
  const auto now = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                [&](const Speed& s) { return s.value >= session.speed() - 1e-9; });
  const auto i = std::clamp<std::ptrdiff_t>((now - kSpeeds.begin()) + by, 0,
                                            static_cast<std::ptrdiff_t>(kSpeeds.size()) - 1);
  session.set_speed(kSpeeds[static_cast<std::size_t>(i)].value);
}

void change_scale(App& app, double by) {
  app.desk.scale = std::clamp(std::round(10.0 * (app.desk.scale + by)) / 10.0, 0.8, 1.5);
  app.tell("Interface at " + fixed(100.0 * app.desk.scale, 0) + " %");
}

void choose_mode(App& app, int index) {
  Settings s = app.session.settings();
  s.mode = static_cast<Mode>(index);
  app.change(s);
}

/// Moves keyboard focus to the next open panel, or the previous one.
void focus_next_panel(bool back) {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  std::vector<ImGuiWindow*> panels;
  for (ImGuiWindow* w : g.Windows) {
    const bool inner = (w->Flags & ImGuiWindowFlags_ChildWindow) != 0;
    const bool without_keys = (w->Flags & ImGuiWindowFlags_NoNavInputs) != 0;
    if (w->WasActive && !w->Hidden && !inner && !without_keys) panels.push_back(w);
  }
  if (panels.empty()) return;
  // Reading order: left to right, then down.
  std::stable_sort(panels.begin(), panels.end(), [](const ImGuiWindow* a, const ImGuiWindow* b) {
    return a->Pos.x != b->Pos.x ? a->Pos.x < b->Pos.x : a->Pos.y < b->Pos.y;
  });
  const ImGuiWindow* now = g.NavWindow != nullptr ? g.NavWindow->RootWindow : nullptr;
  const auto at = std::find(panels.begin(), panels.end(), now);
  const auto count = static_cast<std::ptrdiff_t>(panels.size());
  std::ptrdiff_t next = back ? count - 1 : 0;
  if (at != panels.end()) next = ((at - panels.begin()) + (back ? count - 1 : 1)) % count;
  ImGuiWindow* panel = panels[static_cast<std::size_t>(next)];
  ImGui::FocusWindow(panel);
  ImGui::NavInitWindow(panel, true);
  g.NavDisableHighlight = false;
}

constexpr std::array<KeyAction, 21> kActions{
    {{"Space", " ", "play, pause",
      [](App& app, char) {
        // The focused control handles the space bar.
        if (!ImGui::GetIO().NavVisible) app.session.toggle();
      },
      true},
     {",  .", ",.", "one frame back, one forward",
      [](App& app, char typed) {
        app.session.pause();
        typed == '.' ? app.session.request_step() : app.session.step_back();
      }},
     {";", ";", "one sub-step", [](App& app, char) { app.session.substep(); }},
     {"R", "rR", "back to the start", [](App& app, char) { app.reset(); }},
     {"[  ]", "[]", "slower, faster",
      [](App& app, char typed) { change_speed(app.session, typed == ']' ? 1 : -1); }},
     {"1 … 8", "12345678", "stabilisation mode",
      [](App& app, char typed) { choose_mode(app, typed - '1'); }},
     {"B", "bB", "throw a ball at the pointer", [](App& app, char) { throw_ball(app, app); }},
     {"F", "fF", "show everything", [](App& app, char) { app.view.frame_all(app.session); }},
     {"V", "vV", "compared: ghosts or side by side",
      [](App& app, char) { app.desk.split = !app.desk.split; }},
     {"H", "hH", "panels on or off", [](App& app, char) { app.desk.panels = !app.desk.panels; }},
     {"T", "tT", "light or dark", [](App& app, char) { app.desk.dark = !app.desk.dark; }, true},
     {"+  −", "+=-", "larger or smaller interface",
      [](App& app, char typed) { change_scale(app, typed == '-' ? -0.1 : 0.1); }, true},
     {"G", "gG", "the guided tour, and its next step",
      [](App& app, char) { advance_tour(app.desk); }, true},
     {"L", "lL", "copy the link",
      [](App& app, char) {
        if (app.host.copy_link) app.host.copy_link("");
      }},
     {"C", "cC", "copy the command", [](App& app, char) { copy_command(app); }},
     {"O", "oO", "open a scene file",
      [](App& app, char) {
        if (app.host.open_file) app.host.open_file();
      }},
     {"E", "eE", "edit the scene as text",
      [](App& app, char) {
        const bool open = app.desk.tab == Tab::kText && app.desk.panels && app.desk.right.open;
        open ? close_scene_text(app.desk) : open_scene_text(app.desk);
      }},
     {"M", "mM", "edit the model by hand",
      [](App& app, char) {
        const bool open = app.desk.tab == Tab::kModel && app.desk.panels && app.desk.right.open;
        open ? close_scene_text(app.desk) : open_model(app.desk);
      }},
     {"S", "sS", "save the scene as it is now", [](App& app, char) { app.save_scene(); }},
     {"P", "pP", "picture of the window",
      [](App& app, char) { capture_window(app.session, app.desk); }},
     {"?", "?", "this list", [](App& app, char) { app.desk.help = !app.desk.help; }}}};

}  // namespace

std::span<const KeyAction> key_actions() { return kActions; }

void handle_keys(App& app) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || io.KeySuper) return;
  for (const ImWchar c : io.InputQueueCharacters) {
    if (c >= 128) continue;
    const char key = static_cast<char>(c);
    for (const KeyAction& action : kActions) {
      if (app.introduction.open() && !action.on_first_screen) continue;
      if (action.typed.find(key) != std::string_view::npos) action.act(app, key);
    }
  }
  if (app.introduction.open()) return;
  if (ImGui::IsKeyPressed(ImGuiKey_F6)) focus_next_panel(io.KeyShift);
  if (ImGui::IsKeyPressed(ImGuiKey_Home)) app.session.go_to(0);
  if (ImGui::IsKeyPressed(ImGuiKey_End)) app.session.go_to(app.session.timeline().size() - 1);
}

}  // namespace substep::ui
