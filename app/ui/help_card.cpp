// The "?" card: about, all keys, and gestures of fingers and mouse.

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "app/text/citation.hpp"
#include "app/ui/card.hpp"
#include "app/ui/keys.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

struct Gesture {
  std::string_view shown;
  std::string_view what;
};
// Handled by Dear ImGui and the pointer; the table of keys is in keys.cpp.
constexpr std::array<Gesture, 13> kGestures{
    {{"click a body", "show its values"},
     {"drag a body", "pull it, while it plays"},
     {"drag beside", "turn the view"},
     {"right drag, Shift drag", "move the view"},
     {"wheel, pinch", "closer, farther"},
     {"wheel on a plot", "more or less time"},
     {"drag, click on a plot", "that range, that moment"},
     {"Ctrl click on a slider", "type the value, as on its number"},
     {"drop a file", "run your own scene"},
     {"Home, End", "first and last saved frame"},
     {"F6, Shift F6", "next panel, the one before"},
     {"Tab, arrows", "controls of a panel"},
     {"Esc", "close a card"}}};

// Lines of one column. @return its height
template <class Lines>
float draw_lines(const Look& look, ImVec2 at, float key_width, const Lines& lines) {
  constexpr float kLineHeight = 20.0F;
  const float top = at.y;
  for (const auto& line : lines) {
    draw_text(look.fonts.medium, at, look.theme->text, line.shown);
    draw_text(look.fonts.regular, {at.x + key_width, at.y}, look.theme->dim, line.what);
    at.y += kLineHeight;
  }
  return at.y - top;
}

// Purpose, authors of the method, and licence.
void about(const Look& look, Lab& lab, Desk& desk) {
  const Theme& t = *look.theme;
  card_title(look, 0, Icon::kNone, "substep");
  label(look.fonts.regular, t.text, kPurpose);
  label(look.fonts.small, t.dim,
        std::string("After the paper “") + kPaperTitle + "”, " + kPaperAuthors + ", doi " +
            kPaperDoi + ". " + kLicence + ".");
  if (button(look, "bibtex", Icon::kNone, "Copy BibTeX of the paper", ButtonKind::kPlain, 0.0F,
             look.m.row, "The paper's entry for a bibliography")) {
    ImGui::SetClipboardText(kPaperBibtex);
    lab.tell("BibTeX copied");
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "introduction", Icon::kNone, "First screen", ButtonKind::kPlain, 0.0F,
             look.m.row, "Two chains side by side; afterwards this run restarts")) {
    desk.help = false;
    desk.follow = "introduction=on";
  }
  if (lab.host.open_article) {
    ImGui::SameLine(0.0F, 8.0F);
    if (button(look, "article", Icon::kNone, "Article", ButtonKind::kPlain, 0.0F, look.m.row,
               "An article with two laboratories in it, as an example for your own")) {
      lab.host.open_article();
    }
  }
  space(8.0F);
}

}  // namespace

void help_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  if (!desk.help) return;
  const bool two = ImGui::GetIO().DisplaySize.x > 760.0F;  // columns
  bool close = ImGui::IsKeyPressed(ImGuiKey_Escape, false);
  if (begin_card(look, "##help", two ? 656.0F : 400.0F, card_middle(viewport))) {
    about(look, lab, desk);
    section(look, two ? "Keys and gestures" : "Gestures and keys");
    const ImVec2 at = ImGui::GetCursorScreenPos();
    constexpr float kKeys = 64.0F;
    constexpr float kGestured = 166.0F;
    float height = 0.0F;
    if (two) {
      height = std::max(draw_lines(look, at, kKeys, key_actions()),
                        draw_lines(look, {at.x + 286.0F, at.y}, kGestured, kGestures));
    } else {  // a phone has no keyboard
      height = draw_lines(look, at, kGestured, kGestures) + 12.0F;
      height += draw_lines(look, {at.x, at.y + height}, kKeys, key_actions());
    }
    ImGui::Dummy({1.0F, height});
    close |= card_closed(look);
  }
  ImGui::End();
  if (close) desk.help = false;
}

}  // namespace substep::ui
