// Rings around joints that a link or a page points out.

#include <algorithm>
#include <string>
#include <vector>

#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "core/model/joint_fields.hpp"

namespace substep::ui {

void joint_rings(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport) {
  const Scene& scene = lab.scene_in(0);
  const Poses& poses = lab.poses_in(0);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ViewRect& pane = viewport.panes.front();
  draw.PushClipRect({pane.x, pane.y}, {pane.x + pane.width, pane.y + pane.height}, true);
  std::vector<std::string> ringed = desk.ringed;
  const int selected = desk.model.joint;
  if (desk.tab == Tab::kModel && selected >= 0 && index(selected) < scene.joints.size()) {
    ringed.push_back(base(scene.joints[index(selected)]).name);
  }
  for (const std::string& name : ringed) {
    const auto found = std::find_if(scene.joints.begin(), scene.joints.end(),
                                    [&](const Joint& joint) { return base(joint).name == name; });
    if (found == scene.joints.end()) continue;
    const JointBase& joint = base(*found);
    const auto a = static_cast<std::size_t>(joint.a);
    const Vec3 x = poses.x[a] + poses.q[a] * joint.anchor_a;
    constexpr double kFarAway = 1e6;  // bodies of a failed run fly apart [m]
    ImVec2 centre;
    if (!(x.norm() < kFarAway) || !project(viewport, x, centre)) continue;
    constexpr float kRadius = 16.0F;
    draw.AddCircle(centre, kRadius, to_u32(look.theme->view.background_bottom, 0.55F), 0, 6.0F);
    draw.AddCircle(centre, kRadius, look.theme->accent_hover, 0, 3.0F);
    ring_label(look, draw, centre, kRadius, pane, name);
  }
  draw.PopClipRect();
}

}  // namespace substep::ui
