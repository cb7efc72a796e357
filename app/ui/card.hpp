#pragma once
// Cards over the picture: errors and explanations.

#include <imgui.h>

#include <optional>
#include <string>

#include "app/lab/session.hpp"
#include "app/ui/viewport.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {

/// A card of a width, centred in the view; ImGui::End() ends it. @param centre_y, pivot_y where on
/// the display, and which height of the card lies there, 0 the top @param centre_x where not there
bool begin_card(const Look& look, const Viewport& viewport, const char* id, float width,
                float centre_y, float pivot_y, std::optional<float> centre_x = {});
/// Where a tall card's middle lies: in the view, or in the window where the view is low.
float card_middle(const Viewport& viewport);
struct CardPlace {
  float y = 0.0F;
  float pivot = 0.0F;  // of the card, that lies at y: 0 its top, 1 its bottom
  float x = 0.0F;      // of its middle
};
/// Where a card covers little of a picture: at its lower edge, or, where panels are below it, on
/// those, under the bar that plays and the tabs.
CardPlace card_below(const ViewRect& picture);
/// The same place, or another at the picture's edges where the card covers less of the bodies, or
/// over the panel at its right where bodies fill the picture.
/// @param size of the card  @param which as it was chosen before, or -1; then it is chosen
CardPlace card_beside(const Session& session, const Viewport& viewport, ImVec2 size, int& which);
void card_title(const Look& look, ImU32 mark, Icon icon, const std::string& title);
/// The cross at its corner, the last thing in a card. @return whether it was clicked
bool card_closed(const Look& look);

}  // namespace substep::ui
