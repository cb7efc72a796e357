// Text overlays of the picture.

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/lab/stiffness.hpp"
#include "app/text/caption.hpp"
#include "app/text/format.hpp"
#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/names.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep::ui {
namespace {

std::string solver_words(const Settings& s) {
  std::string words = entry_of(s.solver).title;
  if (entry_of(s.solver).sweeps) words += " " + std::to_string(s.iterations);
  if (reads(s, "share_iterations") && s.share_iterations) words += " per frame";
  if (reads(s, "refinements") && s.refinements > 0) {
    words += ", refined " + std::to_string(s.refinements);
  }
  if (reads(s, "forces")) words += ", forces " + std::string(name_of(s.forces));
  return words;
}

std::string method_line(const Settings& s) {
  std::string line = with_values(entry_of(s.mode).caption, s);
  if (has_islands(s)) line += ", by island";
  line += "  ·  " + solver_words(s);
  const bool as_leapfrog = s.integrator == Integrator::kStormer && !follows_accelerations(s);
  return line + "  ·  " + entry_of(as_leapfrog ? Integrator::kLeapfrog : s.integrator).title;
}

}  // namespace

void draw_over(const Look& look, ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color,
               std::string_view text) {
  const ImU32 halo = to_u32(look.theme->view.background_top, 0.55F);
  for (const ImVec2 d : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)}) {
    draw_text(draw, font, at + d, halo, text);
  }
  draw_text(draw, font, at, color, text);
}

bool project(const Viewport& viewport, const Vec3& x, ImVec2& out, std::size_t pane) {
  const Eigen::Vector4f p = viewport.pictures[pane].view_projection * x.cast<float>().homogeneous();
  if (p.w() <= 0.0F) return false;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  out = {(0.5F + 0.5F * p.x() / p.w()) * size.x, (0.5F - 0.5F * p.y() / p.w()) * size.y};
  return true;
}

double pixel_size(const Viewport& viewport, const Vec3& x) {
  const auto depth = static_cast<double>(
      viewport.pictures.front().view_projection.row(3).dot(x.cast<float>().homogeneous()));
  return 2.0 * std::max(0.0, depth) * std::tan(0.5 * OrbitCamera::kFieldOfView) /
         std::max(1.0, static_cast<double>(viewport.panes.front().height));
}

// Caption of the large number. @param left remaining sub-steps of the frame
std::string unit_of_n(const FrameReport& report, int left) {
  const bool islands = report.islands > 0;
  if (left > 0 && islands) return "sub-steps, " + std::to_string(left) + " to go";
  if (left > 0) return "of " + std::to_string(report.n_substeps + left) + " sub-steps";
  if (report.asleep > 0) return "sub-steps, " + std::to_string(report.asleep) + " asleep";
  if (islands) return "sub-steps, mean " + fixed(report.n_mean, 1);
  return report.n_substeps == 1 ? "step per frame" : "sub-steps";
}

// Of the caption: on a ground, because bodies of the text's own colour pass behind it.
void draw_in_caption(const Look& look, ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color,
                     const std::string& text) {
  const ImVec2 size = text_size(font, text);
  draw.AddRectFilled({at.x - 6.0F, at.y - 1.0F}, at + size + ImVec2(6.0F, 1.0F),
                     to_u32(look.theme->view.background_top, 0.7F), 6.0F);
  draw_text(draw, font, at, color, text);
}

void caption(const Look& look, const Session& session, Desk& desk, const Viewport& viewport,
             bool phone) {
  const Theme& t = *look.theme;
  const ViewRect& v = viewport.view_rect;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const float pad = phone ? 12.0F : 16.0F;
  const FrameReport& report = session.report();
  const bool stepped = report.n_substeps > 0 || report.asleep > 0;
  const bool has_n = stepped && viewport.panes.size() == 1;  // else each pane shows its own
  if (desk.whole) {
    desk.shown_n = {std::to_string(report.n_substeps), unit_of_n(report, session.substeps_left())};
  }
  const auto& [n, unit] = has_n ? desk.shown_n : ShownN{};
  const ImVec2 n_size = text_size(look.fonts.large, n);
  const float unit_width = text_size(look.fonts.regular, unit).x;
  const auto room_beside = [&](float width) {
    return v.width - 2.0F * pad - std::max(width, 80.0F) - 16.0F;
  };
  const ImVec2 at(v.x + pad, v.y + pad);
  draw_in_caption(look, draw, look.fonts.title, at, t.text,
                  fitted(look.fonts.title, session.scene().title, room_beside(n_size.x)));
  draw_in_caption(
      look, draw, look.fonts.regular, {at.x, at.y + 28.0F}, t.dim,
      fitted(look.fonts.regular, method_line(session.settings()), room_beside(unit_width)));
  if (!has_n) return;
  const float right = v.x + v.width - pad;
  draw_in_caption(look, draw, look.fonts.large, {right - n_size.x, at.y - 4.0F}, t.text, n);
  draw_in_caption(look, draw, look.fonts.regular, {right - unit_width, at.y + 28.0F}, t.dim, unit);
}

void body_labels(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport) {
  if (!desk.view.labels) return;
  const Scene& scene = lab.scene_in(0);
  const Poses& poses = lab.poses_in(0);
  double lightest = 0.0;
  for (const Body& body : scene.bodies) {
    if (!body.is_static && (lightest == 0.0 || body.mass < lightest)) lightest = body.mass;
  }
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ViewRect& v = viewport.panes.front();
  const std::size_t own = lab.session.loaded().bodies.size();  // thrown balls have no label
  for (std::size_t i = 0; i < own; ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static || body.mass < 20.0 * lightest) continue;
    ImVec2 p;
    if (!project(viewport, poses.x[i], p)) continue;
    const std::string text = grouped(body.mass) + " kg";
    const ImVec2 size = text_size(look.fonts.small, text);
    // Below a hanging body, above one that rests on others.
    const bool below = scene.effects.joints && !scene.effects.contact;
    float low = p.y;
    float high = p.y;
    const auto solid = outline(body.shape);
    if (solid && !solid->is_ball()) {
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                        (corner & 4) != 0 ? 1 : -1);
        ImVec2 c;
        if (project(viewport, poses.x[i] + poses.q[i] * solid->half_extents.cwiseProduct(sign),
                    c)) {
          low = std::max(low, c.y);
          high = std::min(high, c.y);
        }
      }
    } else if (solid) {
      ImVec2 c;
      if (project(viewport, poses.x[i] - Vec3(0.0, solid->rounding, 0.0), c)) low = c.y;
      if (project(viewport, poses.x[i] + Vec3(0.0, solid->rounding, 0.0), c)) high = c.y;
    }
    const ImVec2 at(p.x - 0.5F * size.x, below ? low + 6.0F : high - 8.0F - size.y);
    constexpr float kCaption = 68.0F;  // height of the caption above
    if (at.y < v.y + kCaption || at.x < v.x || at.x + size.x > v.x + v.width ||
        at.y + size.y > v.y + v.height)
      continue;
    draw_over(look, draw, look.fonts.small, at, look.theme->text, text);
  }
}

void tint_scale(const Look& look, const Session& session, const Compare& compare, const Desk& desk,
                const Viewport& viewport) {
  if (!desk.view.tint || compare.open()) return;
  if (stiffness_shares(session.scene(), session.state()).empty()) return;
  const ViewPalette& palette = look.theme->view;
  const ViewRect& v = viewport.view_rect;
  constexpr float kHalf = 48.0F;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ImVec2 at(v.x + 16.0F, v.y + v.height - 28.0F);
  const double r = session.state().r;  // of the stiffest body
  std::string text = "k/M, 0 to " + short_number(r) + " s⁻²";
  // The buttons in the other corner, see tour_card.cpp, leave room for the whole sentence or not.
  const ImGuiWindow* buttons = ImGui::FindWindowByName("##tour_button");
  const float end = buttons != nullptr && buttons->Active ? buttons->Pos.x : v.x + v.width;
  const std::string sentence = text + ": orange needs the smallest steps";
  const float room = end - at.x - 2 * kHalf - 24.0F;
  if (text_size(look.fonts.small, sentence).x < room) text = sentence;
  const ImVec2 size = text_size(look.fonts.small, text);
  draw.AddRectFilled({at.x - 8.0F, at.y - 8.0F},
                     {at.x + 2 * kHalf + 16.0F + size.x, at.y - 2.0F + size.y},
                     fade(look.theme->panel, 0.7F), look.m.radius);
  const ImU32 low = to_u32(palette.stiff_low, 1.0F);
  const ImU32 mid = to_u32(palette.stiff_mid, 1.0F);
  const ImU32 high = to_u32(palette.stiff_high, 1.0F);
  draw.AddRectFilledMultiColor(at, {at.x + kHalf, at.y + 6.0F}, low, mid, mid, low);
  draw.AddRectFilledMultiColor({at.x + kHalf, at.y}, {at.x + 2 * kHalf, at.y + 6.0F}, mid, high,
                               high, mid);
  draw.AddRect(at, {at.x + 2 * kHalf, at.y + 6.0F}, fade(look.theme->faint, 0.6F));
  draw_over(look, draw, look.fonts.small, {at.x + 2 * kHalf + 8.0F, at.y - 5.0F}, look.theme->text,
            text);
}

}  // namespace substep::ui
