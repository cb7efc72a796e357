#pragma once
// What the keyboard does: the one table that acts on keys and that the list of keys is made from.

#include <span>
#include <string_view>

struct ImGuiWindow;

namespace substep {

struct App;

namespace ui {

/// One line of the list: keys that belong together.
struct KeyAction {
  std::string_view shown;  // what the list calls them
  std::string_view typed;  // the characters that do it, each at its place on the keyboard's layout
  std::string_view what;
  void (*act)(App& app, char typed) = nullptr;
  bool on_first_screen = false;  // others wait until it is left
};
std::span<const KeyAction> key_actions();

/// Acts on what was typed in this frame, unless text is being typed somewhere.
void handle_keys(App& app);

/// The keyboard goes to the next panel that is open, or to the one before.
void focus_next_panel(bool back);

}  // namespace ui
}  // namespace substep
