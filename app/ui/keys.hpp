#pragma once
// Keyboard shortcuts: one table for handling keys and for the list of keys.

#include <span>
#include <string_view>

namespace substep {

struct App;

namespace ui {

/// One line of the list: related keys.
struct KeyAction {
  std::string_view shown;  // name in the list
  std::string_view typed;  // the characters that trigger it, by keyboard layout
  std::string_view what;
  void (*act)(App& app, char typed) = nullptr;
  bool on_first_screen = false;  // others are disabled on the first screen
};
std::span<const KeyAction> key_actions();

/// Handles the keys typed in this frame, unless a text field is active.
void handle_keys(App& app);

}  // namespace ui
}  // namespace substep
