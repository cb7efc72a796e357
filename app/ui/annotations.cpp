// Overlays of the picture: forces, contacts, frames, errors, the selected body and the hand.
// Disabled ones are not computed.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/render/hull.hpp"
#include "app/text/format.hpp"
#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/joint_fields.hpp"

namespace substep::ui {
namespace {

struct Segment {
  ImVec2 from;
  ImVec2 to;
};

/// What all overlays need.
struct Sketch {
  const Look& look;
  const Session& session;
  const Viewport& viewport;
  ImDrawList& draw;
};

std::optional<Segment> seen(const Sketch& in, const Vec3& from, const Vec3& to,
                            std::size_t pane = 0) {
  Segment s;
  if (!project(in.viewport, from, s.from, pane) || !project(in.viewport, to, s.to, pane))
    return std::nullopt;
  return s;
}

ImU32 ground(const Sketch& in, float opacity) {
  return to_u32(in.look.theme->view.background_bottom, opacity);
}

// A line with an outline in the background colour: visible on bright and dark bodies.
void draw_line(const Sketch& in, const Segment& s, ImU32 color, float width = 1.75F) {
  in.draw.AddLine(s.from, s.to, ground(in, 0.5F), width + 2.0F);
  in.draw.AddLine(s.from, s.to, color, width);
}

void draw_arrow(const Sketch& in, const Segment& s, ImU32 color) {
  const ImVec2 d(s.to.x - s.from.x, s.to.y - s.from.y);
  const float length = std::sqrt(d.x * d.x + d.y * d.y);
  if (length < 2.0F) return;
  const ImVec2 t(d.x / length, d.y / length);
  const float head = std::min(8.0F, 0.6F * length);
  const ImVec2 neck(s.to.x - head * t.x, s.to.y - head * t.y);
  draw_line(in, {s.from, neck}, color, 2.0F);
  const float half = 0.5F * head;
  in.draw.AddTriangleFilled(s.to, {neck.x - half * t.y, neck.y + half * t.x},
                            {neck.x + half * t.y, neck.y - half * t.x}, color);
}

Vec3 anchor_of(const Session& session, const JointBase& joint) {
  const auto a = static_cast<std::size_t>(joint.a);
  const Poses& poses = session.poses();
  return poses.x[a] + poses.q[a] * joint.anchor_a;
}

Vec3 error_of(const Session& session, const Joint& joint) {
  const JointBase& j = base(joint);
  const Poses& poses = session.poses();
  const auto b = static_cast<std::size_t>(j.b);
  const Vec3 x = j.b == kWorld ? Vec3(Vec3::Zero()) : poses.x[b];
  const Quat q = j.b == kWorld ? Quat(Quat::Identity()) : poses.q[b];
  return gap_of(joint, anchor_of(session, j) - (x + q * j.anchor_b), q);
}

Vec3 point_of(const Session& session, const ContactForce& contact) {
  return session.poses().x[static_cast<std::size_t>(contact.a)] + contact.arm_a;
}

// The force of a full-length arrow: the weight of all moving bodies, if there is gravity.
double force_scale(const Session& session) {
  const Scene& scene = session.scene();
  double mass = 0.0;
  for (const Body& body : scene.bodies) mass += body.is_static ? 0.0 : body.mass;
  const double g = scene.effects.gravity ? scene.gravity.norm() : 9.81;
  return std::max(1e-9, mass * g);
}

// Length is proportional to the square root of the force: a link's weight and the box's are both
// visible.
void force_arrow(const Sketch& in, const Vec3& at, const Vec3& force, double scale, ImU32 color) {
  constexpr double kFull = 48.0;   // length for a force equal to the scale [px]
  constexpr double kMost = 110.0;  // [px]
  const double f = force.norm();
  if (!(f > 1e-4 * scale)) return;
  const double length = std::min(kMost, kFull * std::sqrt(f / scale)) * pixel_size(in.viewport, at);
  if (const auto s = seen(in, at, at + length / f * force)) {
    draw_arrow(in, *s, color);
  }
}

void draw_forces(const Sketch& in) {
  const Theme& t = *in.look.theme;
  const Scene& scene = in.session.scene();
  const ConstraintForces& forces = in.session.forces();
  const double scale = force_scale(in.session);
  for (std::size_t i = 0; i < forces.joints.size(); ++i) {
    force_arrow(in, anchor_of(in.session, base(scene.joints[i])), forces.joints[i].force, scale,
                t.amber);
  }
  for (const ContactForce& contact : forces.contacts) {
    force_arrow(in, point_of(in.session, contact), contact.force, scale, t.teal);
  }
}

void draw_contacts(const Sketch& in) {
  const Theme& t = *in.look.theme;
  for (const ContactForce& contact : in.session.forces().contacts) {
    const Vec3 at = point_of(in.session, contact);
    const Vec3 tip = at + 14.0 * pixel_size(in.viewport, at) * contact.normal;
    const auto s = seen(in, at, tip);
    if (!s) continue;
    draw_line(in, *s, t.teal);
    const bool closed = contact.force.squaredNorm() > 0.0;
    in.draw.AddCircleFilled(s->from, 4.0F, closed ? t.teal : ground(in, 1.0F));
    in.draw.AddCircle(s->from, 4.0F, closed ? ground(in, 1.0F) : t.teal, 0, 1.5F);
  }
}

// x, y and z in the colours of the plots: orange, teal, blue.
void draw_axes(const Sketch& in, const Vec3& at, const Quat& q, double length) {
  const Theme& t = *in.look.theme;
  const std::array<ImU32, 3> colors{t.orange, t.teal, t.blue};
  for (int i = 0; i < 3; ++i) {
    if (const auto s = seen(in, at, at + length * (q * Vec3::Unit(i)))) {
      draw_line(in, *s, colors[static_cast<std::size_t>(i)]);
    }
  }
}

void draw_body_axes(const Sketch& in) {
  const Scene& scene = in.session.scene();
  const Poses& poses = in.session.poses();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    draw_axes(in, poses.x[i], poses.q[i], 26.0 * pixel_size(in.viewport, poses.x[i]));
  }
}

void draw_joint_frames(const Sketch& in) {
  const Theme& t = *in.look.theme;
  const Poses& poses = in.session.poses();
  for (const Joint& joint : in.session.scene().joints) {
    const JointBase& j = base(joint);
    const Quat& q = poses.q[static_cast<std::size_t>(j.a)];
    const Vec3 at = anchor_of(in.session, j);
    const double px = pixel_size(in.viewport, at);
    const auto draw_axis = [&](const Vec3& direction) {
      const Vec3 axis = 22.0 * px * direction;
      if (const auto s = seen(in, at - axis, at + axis)) {
        draw_line(in, *s, t.purple, 2.0F);
      }
    };
    if (const auto axes = axes_of(joint); axes && !is_weld(joint)) {
      draw_axis(q * axes->a);
    } else if (const auto pins = crossing_axes_of(joint)) {
      draw_axis(q * pins->a);
      draw_axis(j.b == kWorld ? pins->b : Vec3(poses.q[static_cast<std::size_t>(j.b)] * pins->b));
    } else {
      draw_axes(in, at, q, 14.0 * px);
    }
    ImVec2 p;
    if (project(in.viewport, at, p)) in.draw.AddCircleFilled(p, 3.0F, t.purple);
  }
}

// Joint gaps are too small to be visible: all are magnified by the same power of ten, chosen for
// the largest.
void draw_errors(const Sketch& in, const Desk& desk) {
  const Scene& scene = in.session.scene();
  const FrameReport& report = in.session.report();
  if (scene.joints.empty() || !(report.joint_gap > 0.0) || report.joint_gap_joint < 0) return;
  const auto largest = static_cast<std::size_t>(report.joint_gap_joint);
  const double px = pixel_size(in.viewport, anchor_of(in.session, base(scene.joints[largest])));
  const double power = std::floor(std::log10(36.0 * px / report.joint_gap));
  const double factor = std::pow(10.0, std::clamp(power, 0.0, 12.0));
  for (const Joint& joint : scene.joints) {
    const Vec3 error = error_of(in.session, joint);
    if (error.norm() > 2.0 * report.joint_gap) continue;  // of a spring, which is not in the report
    const Vec3 a = anchor_of(in.session, base(joint));
    const auto s = seen(in, a, a + factor * error);
    if (!s) continue;
    draw_line(in, *s, in.look.theme->orange, 2.5F);
    in.draw.AddCircleFilled(s->to, 3.0F, in.look.theme->orange);
  }
  const std::string text =
      "joint gaps × " + (power > 0.0 ? power_of_ten(static_cast<int>(power)) : "1");
  const ViewRect& v = in.viewport.view_rect;
  const float up = desk.view.tint ? 48.0F : 28.0F;
  draw_over(in.look, in.draw, in.look.fonts.small, {v.x + 16.0F, v.y + v.height - up - 5.0F},
            in.look.theme->dim, text);
}

// Outline of a body on the display: the convex hull of its projected corners, or of a ball's rim.
std::vector<ScreenPoint> outline(const Sketch& in, std::size_t body) {
  const Poses& poses = in.session.poses();
  const Vec3& x = poses.x[body];
  std::vector<ScreenPoint> points;
  const auto add = [&](const Vec3& corner) {
    ImVec2 p;
    if (project(in.viewport, corner, p)) points.push_back({p.x, p.y});
  };
  const auto solid = substep::outline(in.session.scene().bodies[body].shape);
  if (solid && !solid->is_ball()) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                      (corner & 4) != 0 ? 1 : -1);
      add(x + poses.q[body] * solid->half_extents.cwiseProduct(sign));
    }
  } else if (solid) {
    const double radius = solid->rounding;
    // The rim is the circle where rays from the eye are tangent.
    const Vec3 to_eye = in.viewport.view.camera.eye(in.viewport.panes.front()) - x;
    const double distance = to_eye.norm();
    if (distance <= radius) return points;
    const Vec3 back = to_eye / distance;
    const Vec3 right = back.unitOrthogonal();
    const Vec3 up = back.cross(right);
    const double sine = radius / distance;
    const double rim = radius * std::sqrt(1.0 - sine * sine);
    for (int i = 0; i < 48; ++i) {
      const double a = 2.0 * 3.14159265358979 * i / 48.0;
      add(x + radius * sine * back + rim * (std::cos(a) * right + std::sin(a) * up));
    }
  }
  return points;
}

void draw_outline(const Sketch& in, int body, ImU32 color) {
  std::vector<ImVec2> hull;
  for (const ScreenPoint& p : convex_hull(outline(in, static_cast<std::size_t>(body)))) {
    hull.emplace_back(p.x, p.y);
  }
  if (hull.size() < 3) return;
  const auto count = static_cast<int>(hull.size());
  in.draw.AddPolyline(hull.data(), count, fade(color, 0.25F), ImDrawFlags_Closed, 6.0F);
  in.draw.AddPolyline(hull.data(), count, color, ImDrawFlags_Closed, 2.0F);
}

void draw_hand(const Sketch& in, const Lab& lab, std::size_t pane) {
  const auto& held = lab.session.held();
  if (!held) return;
  const auto i = static_cast<std::size_t>(held->body);
  const Poses& poses = lab.poses_in(pane);
  if (i >= poses.x.size()) return;
  const auto s = seen(in, poses.x[i] + poses.q[i] * held->anchor, held->target, pane);
  if (!s) return;
  const ImU32 color = in.look.theme->accent_hover;
  draw_line(in, *s, color, 2.0F);
  in.draw.AddCircleFilled(s->from, 4.0F, color);
  in.draw.AddCircle(s->to, 8.0F, color, 0, 2.0F);
}

}  // namespace

void annotations(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const Sketch in{look, lab.session, viewport, draw};
  const ViewOptions& show = desk.view;
  const auto clip = [&](const ViewRect& r) {
    draw.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
  };
  if (!lab.frozen()) {  // else they would be those of a later frame
    clip(viewport.panes.front());
    if (desk.selected >= 0) {
      draw_outline(in, desk.selected, look.theme->accent_hover);
    }
    if (show.axes) draw_body_axes(in);
    if (show.frames) draw_joint_frames(in);
    if (show.contacts) draw_contacts(in);
    if (show.forces) draw_forces(in);
    if (show.errors) draw_errors(in, desk);
    draw.PopClipRect();
  }
  for (std::size_t pane = 0; pane < viewport.panes.size(); ++pane) {
    clip(viewport.panes[pane]);
    draw_hand(in, lab, pane);
    draw.PopClipRect();
  }
}

}  // namespace substep::ui
