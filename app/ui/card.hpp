#pragma once
// Cards over the picture: errors and explanations.

#include <imgui.h>

#include <string>

#include "app/lab/session.hpp"
#include "app/ui/viewport.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {

struct CardPlace {
  float y = 0.0F;
  float pivot = 0.0F;  // of the card at y: 0 its top, 1 its bottom
  float x = 0.0F;      // centre of the card
};
/// Begins a card of the given width; end it with ImGui::End().
bool begin_card(const Look& look, const char* id, float width, const CardPlace& place);
/// The place of a tall card: the middle of the view, or of the window's height if the view is low.
CardPlace card_middle(const Viewport& viewport);
/// A place that covers little of a picture: at its lower edge, or, if panels are below it, on
/// those, under the transport bar and the tabs.
CardPlace card_below(const ViewRect& picture);
/// card_below(), or another place at the picture's edges if the card covers less of the bodies
/// there, or over the end of a panel if bodies fill the picture, rather of the controls than of the
/// plots.
/// @param size of the card @param which the earlier choice, or -1 to choose
CardPlace card_beside(const Session& session, const Viewport& viewport, ImVec2 size, int& which);
void card_title(const Look& look, ImU32 mark, Icon icon, const std::string& title);
/// The close button in the corner; call last in a card. @return whether it was clicked
bool card_closed(const Look& look);

}  // namespace substep::ui
