// Cards for slow frames: before the start, and during computation.

#include <algorithm>

#include "app/text/format.hpp"
#include "app/ui/card.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {

void heavy_card(const Look& look, Lab& lab, const Viewport& viewport) {
  HeavyStart& heavy = lab.heavy;
  if (heavy.why.empty() || lab.session.stopped()) return;
  if (lab.session.playing() || !lab.held()) {
    heavy = {};
    return;
  }
  bool close = false;
  bool back = false;
  if (begin_card(look, "##heavy", 400.0F, card_middle(viewport))) {
    card_title(look, look.theme->amber, Icon::kPause, "Paused: this run is heavy");
    label(look.fonts.small, look.theme->dim, heavy.why);
    if (button(look, "run", Icon::kPlay, "Run it", ButtonKind::kPrimary, 0.0F, 28.0F,
               "Play (Space)")) {
      lab.session.play();
    }
    ImGui::SameLine(0.0F, 8.0F);
    back = button(look, "back", Icon::kNone, "Go back", ButtonKind::kPlain, 0.0F, 28.0F,
                  ("Back to \"" + heavy.before.scene->title + "\""));
    close = card_closed(look) || ImGui::IsKeyPressed(ImGuiKey_Escape, false);
  }
  ImGui::End();
  if (back) lab.run(heavy.before);
  if (close || back) heavy = {};
}

void long_frame_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  constexpr int kPatience = 20;  // pictures
  const FrameSlices& slices = lab.session.slices();
  const bool behind = lab.compare.behind(lab.session);
  const int change = slices.open() || behind ? 1 : -1;
  desk.pictures_in_frame = std::clamp(desk.pictures_in_frame + change, 0, 2 * kPatience);
  if (change < 0 || desk.pictures_in_frame < kPatience) return;
  bool cancel = ImGui::IsKeyPressed(ImGuiKey_Escape, false);
  if (begin_card(look, "##long_frame", 300.0F, card_below(viewport.view_rect))) {
    const int taken = slices.taken();
    card_title(look, look.theme->amber, Icon::kSubstep,
               behind ? "A compared method is slow"
                      : "Sub-step " + grouped(taken) + " of " + grouped(taken + slices.left()));
    label(look.fonts.small, look.theme->dim,
          behind ? "The run waits for it." : "This frame takes long to compute.");
    cancel |= button(look, "cancel", Icon::kNone, "Cancel", ButtonKind::kPlain, 0.0F, 28.0F,
                     behind ? "Ends the comparison (Esc)" : "Back to the last frame, paused (Esc)");
  }
  ImGui::End();
  if (!cancel) return;
  if (behind) lab.compare.close();
  lab.session.pause();
}

}  // namespace substep::ui
