// The card of the selected body: properties, motion, constraints, required N.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/stiffness.hpp"
#include "app/text/format.hpp"
#include "app/ui/model_actions.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep::ui {
namespace {

void row(const Look& look, const std::string& name, const std::string& value,
         std::string_view tip = "") {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  draw_text(look.fonts.small, at, look.theme->dim, name);
  const float left = text_size(look.fonts.small, name).x + 12.0F;
  draw_text_before(look.fonts.small, {at.x + width, at.y}, look.theme->text,
                   fitted(look.fonts.small, value, width - left));
  ImGui::PushID(name.c_str());
  ImGui::InvisibleButton("row", {width, 16.0F});
  ImGui::PopID();
  tooltip(look, name, tip);
}

std::string triple(const Vec3& v, int digits, const char* unit) {
  return "x " + fixed(v.x(), digits) + "  y " + fixed(v.y(), digits) + "  z " +
         fixed(v.z(), digits) + unit;
}

std::string newtons(double force) {
  const Unit unit = unit_for(force);
  return short_number(force / unit.factor) + ' ' + unit.prefix + 'N';
}

void motion_rows(const Look& look, const Session& session, std::size_t i, bool phone) {
  const State& state = session.state();
  const Vec6& u = state.u[i];
  row(look, "position", triple(state.x[i], phone ? 1 : 2, " m"), "Centre of mass, in the world.");
  row(look, "speed", short_number(u.head<3>().norm()) + " m/s");
  row(look, "angular speed", short_number(u.tail<3>().norm()) + " rad/s");
}

void stiffness_row(const Look& look, const Session& session, std::size_t i) {
  const State& state = session.state();
  if (state.k.size() <= i || !(state.r > 0.0)) return;
  const double r = stiffest_of(session.scene(), state, i).r;
  const int n = wanted_substeps(session.scene().frame, stable_step(session.settings().alpha, r));
  row(look, "share of the stiffest",
      fixed(100.0 * r / state.r, r < state.r ? 1 : 0) + " %  ·  N " + std::to_string(n),
      "Its largest ratio of the diagonals of K and M, as a share of r (Eq. 9), and the N that it "
      "alone would need (Eqs. 10, 11).");
}

// Joints by their force, and the sum over the contacts.
void force_rows(const Look& look, const Session& session, int body) {
  const Scene& scene = session.scene();
  const ConstraintForces& forces = session.forces();
  struct Pull {
    const std::string* joint;
    double force;
  };
  std::vector<Pull> pulls;
  for (std::size_t j = 0; j < forces.joints.size(); ++j) {
    const JointBase& joint = base(scene.joints[j]);
    if (joint.a != body && joint.b != body) continue;
    pulls.push_back({&joint.name, forces.joints[j].force.norm()});
  }
  std::sort(pulls.begin(), pulls.end(),
            [](const Pull& a, const Pull& b) { return a.force > b.force; });
  constexpr std::size_t kShown = 4;
  for (std::size_t j = 0; j < std::min(kShown, pulls.size()); ++j) {
    row(look, *pulls[j].joint, newtons(pulls[j].force),
        "Force in this joint in the last sub-step of the frame.");
  }
  int touching = 0;
  double pressed = 0.0;
  for (const ContactForce& contact : forces.contacts) {
    if ((contact.a != body && contact.b != body) || contact.force.squaredNorm() == 0.0) continue;
    ++touching;
    pressed += contact.force.dot(contact.normal);
  }
  if (touching == 0) return;
  const std::string name = std::to_string(touching) + (touching == 1 ? " contact" : " contacts");
  row(look, name, newtons(pressed), "Sum of the normal forces in the last sub-step of the frame.");
}

}  // namespace

void selection_card(const Look& look, const Session& session, Desk& desk, const Viewport& viewport,
                    bool phone) {
  const auto count = static_cast<int>(session.scene().bodies.size());
  if (desk.selected >= count) desk.selected = -1;
  if (desk.selected < 0) return;
  const ViewRect& v = viewport.view_rect;
  const auto i = static_cast<std::size_t>(desk.selected);
  const Body& body = session.scene().bodies[i];
  const float width = phone ? 188.0F : 232.0F;
  const bool left = desk.card_left;
  // Above the tour's button and the scale of the tint.
  const float up = 24.0F + look.m.row + 2.0F - (desk.tour >= 0 && phone ? look.m.row : 0.0F);
  ImGui::SetNextWindowPos({left ? v.x + 12.0F : v.x + v.width - 12.0F, v.y + v.height - up},
                          ImGuiCond_Always, {left ? 0.0F : 1.0F, 1.0F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F},
                                      {width, v.height - up - (phone ? 60.0F : 68.0F)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F, 10.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8.0F, 3.0F});
  bool close = false;
  if (ImGui::Begin(
          "##selection", nullptr,
          kPlaced | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing)) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x;
    draw_text(look.fonts.medium, at, look.theme->text,
              fitted(look.fonts.medium, body.name, room - 54.0F));
    ImGui::SetCursorScreenPos({at.x + room - 46.0F, at.y - 2.0F});
    if (button(look, kEditByHand, Icon::kPencil, "", ButtonKind::kGhost, 22.0F, 22.0F,
               "Edit by hand (M)")) {
      open_model(desk);
    }
    ImGui::SetCursorScreenPos({at.x + room - 20.0F, at.y - 2.0F});
    close = button(look, "close", Icon::kCross, "", ButtonKind::kGhost, 22.0F, 22.0F,
                   "Nothing selected (Esc)");
    if (body.is_static) {
      row(look, "mass", "does not move");
    } else {
      row(look, "mass", short_number(body.mass) + " kg");
      if (!phone) {
        row(look, "inertia",
            coarse_number(body.inertia.x()) + "  " + coarse_number(body.inertia.y()) + "  " +
                coarse_number(body.inertia.z()) + " kg m²",
            "Principal moments of inertia.");
      }
      motion_rows(look, session, i, phone);
      stiffness_row(look, session, i);
    }
    force_rows(look, session, desk.selected);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  if (close || ImGui::IsKeyPressed(ImGuiKey_Escape, false)) desk.selected = -1;
}

}  // namespace substep::ui
