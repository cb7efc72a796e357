// The two terms of the criterion, each with the N that it requires: the larger one sets N.

#include <string>

#include "app/lab/criterion.hpp"
#include "app/text/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

// A term, its meaning below, its N on the right; the term that sets N in orange.
void term(const Look& look, const std::string& what, const std::string& meaning, int n, bool sets) {
  constexpr float kText = 14.0F;  // right of the mark
  const Theme& t = *look.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float end = draw_text_before(look.fonts.medium, {at.x + width, at.y - 1.0F},
                                     sets ? t.orange : t.dim, grouped(n));
  draw.AddRectFilled({at.x, at.y + 4.0F}, {at.x + 8.0F, at.y + 12.0F}, sets ? t.orange : t.faint,
                     2.0F);
  draw_text(look.fonts.small_medium, {at.x + kText, at.y}, sets ? t.text : t.dim,
            fitted(look.fonts.small_medium, what, end - at.x - kText - 8.0F));
  draw_text(look.fonts.small, {at.x + kText, at.y + 18.0F}, t.dim,
            fitted(look.fonts.small, meaning, width - kText));
  ImGui::Dummy({width, 36.0F});
}

}  // namespace

void criterion_terms(const Look& look, const Session& session, const Criterion& c) {
  const Scene& scene = session.scene();
  section(look, "Which term sets N", "N");
  tooltip(look, "Which term sets N",
          "Two terms limit a sub-step. Stiffness: a force that rotates with a body acts like a "
          "spring, r = max k/M (Eq. 9). Rotation: a fast body must not rotate too far in a "
          "sub-step; the paper's rule does not include this. Each gives an r and with it an N "
          "(Eqs. 10, 11). The larger N is used.");
  term(look, stiffness_text(scene, c),
       c.stiffness.body < 0 ? "No constraint force rotates with a body."
                            : "k/M " + short_number(c.stiffness.r) + " s⁻², by Eq. 9",
       c.n_stiffness, c.set_by == CriterionTerm::kStiffness);
  term(look, rotation_text(scene, c), rotation_meaning(scene, c), c.n_rotation,
       c.set_by == CriterionTerm::kRotation);
}

}  // namespace substep::ui
