#pragma once
// Cards over the picture: errors and explanations.

#include <imgui.h>

#include <optional>
#include <string>

#include "app/lab/session.hpp"
#include "app/ui/viewport.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {

/// Begins a card of the given width, centred in the view; end it with ImGui::End().
/// @param centre_y position on the display; @param pivot_y height in the card that lies there, 0
/// the top; @param centre_x instead of the view's centre
bool begin_card(const Look& look, const Viewport& viewport, const char* id, float width,
                float centre_y, float pivot_y, std::optional<float> centre_x = {});
/// Middle of a tall card: that of the view, or of the window if the view is low.
float card_middle(const Viewport& viewport);
struct CardPlace {
  float y = 0.0F;
  float pivot = 0.0F;  // of the card at y: 0 its top, 1 its bottom
  float x = 0.0F;      // centre of the card
};
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
