#pragma once
// The controls that panels are made of, drawn our way over Dear ImGui's behaviour: drag, keyboard
// and Ctrl+click to type work as everywhere in it.

#include <imgui.h>

#include <functional>
#include <span>
#include <string>

#include "app/ui/look.hpp"

namespace substep::ui {

/// Text at a whole pixel of the frame buffer, where it is sharpest.
void draw_text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, const char* text,
               const char* end = nullptr);
ImVec2 text_size(ImFont* font, const char* text, float wrap = 0.0F);
/// Same, shortened with an ellipsis to fit a width. @return what was drawn
std::string fitted(ImFont* font, const std::string& text, float width);

/// Same, over several lines, broken at spaces alone: a number stays whole, and with its unit.
std::string wrapped(ImFont* font, const char* text, float width);

/// Text as an item of the layout, wrapped at the panel's width.
void label(ImFont* font, ImU32 color, const char* text);
/// Heading of a section, with a value at the right.
void section(const Look& look, const char* title, const char* value = nullptr,
             ImU32 value_color = 0);
/// Room that a section's title takes.
float heading_width(const Look& look, const char* title);
void space(float height);

/// A ring around the last item where the keyboard is on it.
void draw_focus(const Look& look, ImDrawList& draw, ImVec2 min, ImVec2 max);

/// A line of what is read off a picture.
struct ReadOutLine {
  std::string text;
  ImU32 color = 0;
  bool title = false;
};
/// The lines at the pointer, at once, whole on the display.
void read_out(const Look& look, std::span<const ReadOutLine> lines);

/// A tooltip for the last item: what it is in a line, more below. Shown after a moment.
void tooltip(const Look& look, const char* title, const char* text);

struct Choice {
  const char* name = "";
  const char* tip = "";
};
/// One of a few, side by side. @return whether it changed
bool segmented(const Look& look, const char* id, std::span<const Choice> choices, int& current,
               float width);
/// The same with a name at the left: the rows of an instrument line up.
bool segmented_row(const Look& look, const char* name, std::span<const Choice> choices,
                   int& current, const char* tip);

/// Name, track, value. @param format printf of the value
bool slider(const Look& look, const char* name, double& value, double least, double most,
            bool logarithmic, const char* format, const char* tip);
bool slider(const Look& look, const char* name, int& value, int least, int most, bool logarithmic,
            const char* tip);
/// Over as many powers of ten as there are. @param value, least, most > 0
bool power_slider(const Look& look, const char* name, double& value, double least, double most,
                  const char* tip);

bool checkbox(const Look& look, const char* name, bool& value, float width, const char* tip);

/// A pill that is on or off; those that follow each other fill lines. @param mark colour of what it
/// shows, 0 for none; @param first starts a line
bool toggle(const Look& look, const char* name, bool& value, ImU32 mark, bool first,
            const char* tip);

/// A heading that folds what is below it.
void fold(const Look& look, const char* title, bool& open, const char* tip);

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
  kNone
};
void draw_icon(ImDrawList& draw, Icon icon, ImVec2 centre, float size, ImU32 color);

enum class ButtonKind : unsigned char { kPlain, kPrimary, kGhost };
/// @param text may be empty; @param width 0 fits the content
bool button(const Look& look, const char* id, Icon icon, const char* text, ButtonKind kind,
            float width, float height, const char* tip);

/// How far something is, with a button to cancel it. @param tip of the button @return whether it
/// was pressed
bool progress(const Look& look, double share, const char* tip);

/// A button that opens a menu, the current choice on it.
bool menu_button(const Look& look, const char* id, const char* text, float width, float height,
                 const char* tip, const std::function<void()>& menu);
/// The same with an icon alone.
bool icon_menu(const Look& look, const char* id, Icon icon, ButtonKind kind, float size,
               const char* tip, const std::function<void()>& menu);
/// An entry of such a menu.
bool menu_item(const Look& look, const char* text, const char* note, bool current);

}  // namespace substep::ui
