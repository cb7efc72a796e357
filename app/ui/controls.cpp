// The left panel: scene, method, and display options.

#include <array>
#include <string>

#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

void heading_with_level(const Look& look, Desk& desk) {
  static constexpr std::array<Choice, 2> kLevels{
      {{"Explore", "Scene, method, load and comparison, with the plots of N and energy"},
       {"Lab", "Every setting, plot and measurement"}}};
  constexpr float kSwitch = 132.0F;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float y = at.y + 0.5F * (look.m.row - text_size(look.fonts.caps, "SCENE").y);
  ImGui::SetCursorScreenPos({at.x, y});
  section(look, "Scene");
  ImGui::SetCursorScreenPos({at.x + width - kSwitch, at.y});
  int level = static_cast<int>(desk.level);
  segmented(look, "level", kLevels, level, kSwitch);
  desk.level = static_cast<DeskLevel>(level);
}

// A hint for the scene, or the tip of its button if the Lab's controls need the room.
void scene_controls(const Look& look, Lab& lab, Desk& desk) {
  const Scene& now = lab.session.scene();
  const std::string about = now.look_for.empty() ? now.description : now.look_for;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const bool lab_level = desk.level == DeskLevel::kLab;
  const bool room = !lab_level || display.y >= 800.0F || display.x < 900.0F;
  scene_picker(look, lab, desk, room ? "" : about);
  if (room) label(look.fonts.small, look.theme->dim, about);
}

// Only options that the scene supports; the dots show their colours.
void showing(const Look& look, const Session& session, Desk& desk) {
  const Theme& t = *look.theme;
  const Scene& scene = session.scene();
  const Effects& effects = scene.effects;
  ViewOptions& v = desk.view;
  section(look, "Show");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {6.0F, 6.0F});
  toggle(look, "why this N", v.tint, t.orange, true,
         "Bodies by their k/M (Eq. 9): the orange ones need small steps. Evaluates K in every "
         "mode.");
  toggle(look, "masses", v.labels, 0, false, "Masses of heavy bodies.");
  if (scene.criteria.track) {
    toggle(look, "trail", v.trail, t.blue, false, "Path of the body that the scene tracks.");
  }
  if (effects.joints) toggle(look, "joints", v.joints, 0, false, "Markers of joints.");
  if (effects.joints || effects.contact) {
    toggle(look, "forces", v.forces, t.amber, false,
           "λ of Eq. 3: of joints on their first body in amber, of contacts with friction in "
           "green. Arrow lengths are proportional to the square root of the force; a long one is "
           "the weight of all. Forces of the last sub-step of the frame: earlier impacts within it "
           "are not shown.");
  }
  if (effects.contact) {
    toggle(look, "contacts", v.contacts, t.teal, false,
           "Contact points and normals; filled where they carry a force.");
  }
  if (effects.joints) {
    toggle(look, "gaps", v.errors, t.orange, false,
           "Errors φ of joints, magnified by a power of ten so that the largest is visible.");
    toggle(look, "frames", v.frames, t.purple, false,
           "Axes of hinges, frames of ball joints: x orange, y green, z blue.");
  }
  toggle(look, "axes", v.axes, 0, false,
         "Principal axes of bodies: x orange, y green, z blue. The columns of K are taken along "
         "them (Eq. 4).");
  ImGui::PopStyleVar();
}

}  // namespace

void controls(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  heading_with_level(look, desk);
  scene_controls(look, lab, desk);
  if (desk.level == DeskLevel::kExplore) {
    space(look.m.section);
    return explore_controls(look, lab, desk, viewport);
  }
  Settings s = lab.session.settings();
  effect_switches(look, lab.session);
  space(look.m.section);
  method_controls(look, lab.session.scene(), s, desk.more);
  if (desk.more) effect_table(look, lab);
  space(look.m.section);
  showing(look, lab.session, desk);
  if (s != lab.session.settings()) lab.change(s);
}

}  // namespace substep::ui
