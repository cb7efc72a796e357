// A ring around what failed, with its measure.

#include <algorithm>
#include <cmath>
#include <string>

#include "app/text/verdict_words.hpp"
#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kLeastRing = 15.0F;  // radius [px]
constexpr float kMostRing = 90.0F;

void ring(const Look& look, ImDrawList& draw, const Viewport& viewport, const Failure& failure,
          std::size_t pane, ImU32 color) {
  ImVec2 from;
  ImVec2 to;
  if (!project(viewport, failure.from, from, pane) || !project(viewport, failure.to, to, pane)) {
    return;
  }
  const ImVec2 centre(0.5F * (from.x + to.x), 0.5F * (from.y + to.y));
  float radius = 0.5F * std::hypot(to.x - from.x, to.y - from.y) + 9.0F;
  if (failure.body >= 0) {
    const double pixel = std::max(1e-9, pixel_size(viewport, failure.from));
    radius = static_cast<float>(std::min(1e4, failure.radius / pixel));
  }
  radius = std::clamp(radius, kLeastRing, kMostRing);
  const ImU32 halo = to_u32(look.theme->view.background_bottom, 0.55F);
  if (failure.joint >= 0) {
    draw.AddLine(from, to, halo, 4.0F);
    draw.AddLine(from, to, color, 2.0F);
    for (const ImVec2 end : {from, to}) draw.AddCircleFilled(end, 3.0F, color);
  }
  draw.AddCircle(centre, radius, halo, 0, 6.0F);
  draw.AddCircle(centre, radius, color, 0, 2.5F);
  std::string text = failure.exceeded ? exceeded_label(*failure.exceeded) : "";
  if (!failure.name.empty()) text += (text.empty() ? "" : "  ·  ") + failure.name;
  ring_label(look, draw, centre, radius, viewport.panes[pane], text);
}

}  // namespace

void ring_label(const Look& look, ImDrawList& draw, ImVec2 centre, float radius,
                const ViewRect& pane, const std::string& text) {
  constexpr float kGap = 8.0F;
  const ImVec2 size = text_size(look.fonts.medium, text);
  const float least = pane.x + kGap;
  const float most = std::max(least, pane.x + pane.width - kGap - size.x);
  ImVec2 at(centre.x + radius + kGap, centre.y - 0.5F * size.y);
  if (at.x > most) at.x = centre.x - radius - kGap - size.x;
  if (at.x < least) {
    at = {std::clamp(centre.x - 0.5F * size.x, least, most), centre.y - radius - kGap - size.y};
  }
  draw.AddRectFilled({at.x - 6.0F, at.y - 3.0F}, {at.x + size.x + 6.0F, at.y + size.y + 3.0F},
                     fade(look.theme->panel, 0.8F), look.m.radius);
  draw_text(draw, look.fonts.medium, at, look.theme->text, text);
}

void failure_rings(const Look& look, const Lab& lab, const Viewport& viewport) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  for (std::size_t run = 0; run <= lab.compare.runs().size(); ++run) {
    const auto failure = lab.failure_in(run);
    if (!failure) continue;
    const std::size_t pane = run < viewport.panes.size() ? run : 0;  // as a ghost: over this run
    const bool ghost = run != pane;
    const ViewRect& r = viewport.panes[pane];
    draw.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
    ring(look, draw, viewport, *failure, pane,
         ghost ? compare_color(look, run - 1) : look.theme->orange);
    draw.PopClipRect();
  }
}

void first_tear(const Look& look, const Lab& lab, const Viewport& viewport) {
  constexpr std::size_t kTorn = 1;  // pane of the compared run
  if (!lab.compare.open() || viewport.panes.size() <= kTorn) return;
  const Compare::Run& run = lab.compare.runs().front();
  if (run.verdict->holds() || !run.verdict->exceeded()) return;
  // The report names the widest joint now, the verdict the first one.
  FrameReport then = run.report;
  const auto& joints = run.scene->joints;
  const auto first = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
    return base(joint).name == run.verdict->exceeded()->name;
  });
  if (first == joints.end()) return;
  then.torn_joint = static_cast<int>(first - joints.begin());
  const auto failure = failure_of(*run.scene, run.poses, then, *run.verdict);
  if (!failure) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ViewRect& r = viewport.panes[kTorn];
  draw.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
  ring(look, draw, viewport, *failure, kTorn, look.theme->orange);
  draw.PopClipRect();
}

}  // namespace substep::ui
