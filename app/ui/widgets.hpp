#pragma once
// Controls of the panels, with custom drawing on top of Dear ImGui's behaviour: drag, keyboard and
// Ctrl+click to type work as usual.

#include <imgui.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "app/ui/look.hpp"

namespace substep::ui {

/// Text aligned to whole pixels of the frame buffer, for sharpness.
void draw_text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, std::string_view text);
/// The same in the current window.
void draw_text(ImFont* font, ImVec2 at, ImU32 color, std::string_view text);
/// Ends at `right`. @return its left end
float draw_text_before(ImFont* font, ImVec2 right, ImU32 color, std::string_view text);
ImVec2 text_size(const ImFont* font, std::string_view text);
/// Shortened with an ellipsis to fit a width. @return the text drawn
std::string fitted(ImFont* font, const std::string& text, float width);

/// Broken into lines at spaces only; a number stays whole, and with its unit.
std::string wrapped(ImFont* font, const std::string& text, float width);

/// Text as a layout item, wrapped at the panel's width.
void label(ImFont* font, ImU32 color, const std::string& text);
/// Heading of a section, with a value on the right.
void section(const Look& look, std::string_view title, std::string_view value = "",
             ImU32 value_color = 0);
/// Width of a section's title.
float heading_width(const Look& look, std::string_view title);
void space(float height);

/// A ring around the last item if it has keyboard focus.
void draw_focus(const Look& look);

/// A line of a read-out.
struct ReadOutLine {
  std::string text;
  ImU32 color = 0;
  bool title = false;
};
/// A tooltip at the pointer without delay, kept inside the display.
void read_out(const Look& look, std::span<const ReadOutLine> lines);

/// A tooltip for the last item: a title and a longer text. Shown after a delay; not after
/// a click, until the pointer leaves the item.
void tooltip(const Look& look, std::string_view title, std::string_view text);

struct Choice {
  const char* name = "";
  const char* tip = "";
};
/// A segmented control. @return whether it changed
bool segmented(const Look& look, const char* id, std::span<const Choice> choices, int& current,
               float width);
/// The same with a name on the left, aligned with other rows.
bool segmented_row(const Look& look, const char* name, std::span<const Choice> choices,
                   int& current, const char* tip);

/// The same for an enumeration, whose values are the indices of the choices.
template <class Enum>
void choose(const Look& look, const char* name, std::span<const Choice> choices, Enum& value,
            const char* tip) {
  int index = static_cast<int>(value);
  segmented_row(look, name, choices, index, tip);
  value = static_cast<Enum>(index);
}

/// Name, track, value. @param format printf format of the value
bool slider(const Look& look, const char* name, double& value, double least, double most,
            bool logarithmic, const char* format, const char* tip);
bool slider(const Look& look, const char* name, int& value, int least, int most, bool logarithmic,
            const char* tip);
/// A slider with a logarithmic scale over all its decades. @param value, least, most > 0
bool power_slider(const Look& look, const char* name, double& value, double least, double most,
                  const char* tip);

void checkbox(const Look& look, const char* name, bool& value, const char* tip);

/// A toggle pill; consecutive ones flow into lines. @param mark colour of its subject, 0 for none;
/// @param first starts a line
void toggle(const Look& look, const char* name, bool& value, ImU32 mark, bool first,
            std::string_view tip);

/// A heading that folds the content below it.
void fold(const Look& look, const std::string& title, bool& open, std::string_view tip);

enum class Icon : unsigned char {
  kPlay,
  kPause,
  kStep,
  kSubstep,
  kReset,
  kHelp,
  kSun,
  kMoon,
  kChevron,
  kChevronUp,
  kCheck,
  kCross,
  kFrame,
  kPanels,
  kList,
  kSave,
  kBall,
  kShare,
  kHold,
  kFollow,
  kSweep,
  kUndo,
  kRedo,
  kPencil,
  kNone
};
void draw_icon(ImDrawList& draw, Icon icon, ImVec2 centre, float size, ImU32 color);

enum class ButtonKind : unsigned char { kPlain, kPrimary, kGhost };
/// @param text may be empty; @param width 0: automatic
bool button(const Look& look, const char* id, Icon icon, std::string_view text, ButtonKind kind,
            float width, float height, std::string_view tip);

/// A progress bar with a cancel button. @param tip of the button @return whether it was pressed
bool progress(const Look& look, double share, const char* tip);

/// A button that shows the current choice and opens a menu.
bool menu_button(const Look& look, const char* id, const std::string& text, float width,
                 float height, std::string_view tip, const std::function<void()>& menu);
/// The same with an icon only.
bool icon_menu(const Look& look, const char* id, Icon icon, ButtonKind kind, float size,
               const char* tip, const std::function<void()>& menu);
/// A picture in front of an entry's text.
struct MenuPicture {
  ImVec2 size;
  std::function<void(ImDrawList& draw, ImVec2 min, ImVec2 max)> draw;
};
/// An entry of such a menu.
bool menu_item(const Look& look, const std::string& text, std::string_view note = "",
               bool current = false, const MenuPicture* picture = nullptr);

/// Scrolls the current window by dragging with a finger. If the drag began on a control and is
/// vertical, the window scrolls and the control is released.
void scroll_by_drag();

}  // namespace substep::ui
