// Pointer input in the picture: orbit, pan and zoom; select and drag bodies, throw balls at them.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/render/picking.hpp"
#include "app/ui/model_actions.hpp"
#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"

namespace substep::ui {
namespace {

constexpr float kClick = 4.0F;  // smaller movements are clicks [px]

// The pane at a point of the display; the first pane if none contains it.
std::size_t pane_at(const Viewport& viewport, ImVec2 p) {
  for (std::size_t i = 1; i < viewport.panes.size(); ++i) {
    const ViewRect& r = viewport.panes[i];
    if (p.x >= r.x && p.x < r.x + r.width && p.y >= r.y && p.y < r.y + r.height) return i;
  }
  return 0;
}

Ray ray_at(const Viewport& viewport, ImVec2 p, std::size_t pane) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  return ray_through(viewport.pictures[pane].view_projection.cast<double>(),
                     2.0 * static_cast<double>(p.x / display.x) - 1.0,
                     1.0 - 2.0 * static_cast<double>(p.y / display.y));
}

// The body under the pointer, or close to it: links are thin compared with a fingertip.
std::optional<Hit> body_at(const Lab& lab, const Viewport& viewport, ImVec2 p, std::size_t pane) {
  const bool touch = ImGui::GetIO().MouseSource == ImGuiMouseSource_TouchScreen;
  const float near = touch ? 14.0F : 5.0F;
  static constexpr std::array<ImVec2, 9> kAround{{{0, 0},
                                                  {1, 0},
                                                  {-1, 0},
                                                  {0, 1},
                                                  {0, -1},
                                                  {0.7F, 0.7F},
                                                  {-0.7F, 0.7F},
                                                  {0.7F, -0.7F},
                                                  {-0.7F, -0.7F}}};
  for (const ImVec2 d : kAround) {
    const Ray ray = ray_at(viewport, {p.x + near * d.x, p.y + near * d.y}, pane);
    if (const auto hit = first_hit(ray, lab.scene_in(pane), lab.poses_in(pane))) return hit;
  }
  return std::nullopt;
}

// The moving body whose centre is closest to the pointer, if that is near: between two pictures a
// fast body has moved on.
std::optional<Hit> nearest_moving(const Lab& lab, const Viewport& viewport, ImVec2 p,
                                  std::size_t pane) {
  constexpr float kReach = 28.0F;  // [px]
  const Scene& scene = lab.scene_in(pane);
  const Poses& poses = lab.poses_in(pane);
  std::optional<Hit> nearest;
  float reach = kReach;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    ImVec2 at;
    if (scene.bodies[i].is_static || !project(viewport, poses.x[i], at, pane)) continue;
    const float away = std::hypot(at.x - p.x, at.y - p.y);
    if (away >= reach) continue;
    reach = away;
    const Ray ray = ray_at(viewport, p, pane);
    nearest = Hit{static_cast<int>(i), ray.direction.dot(poses.x[i] - ray.origin)};
  }
  return nearest;
}

bool can_be_held(const Session& session, int body) {
  const auto& bodies = session.scene().bodies;
  const auto i = static_cast<std::size_t>(body);
  return session.playing() && i < bodies.size() && !bodies[i].is_static;
}

// The pointer projected to the plane that faces the view and contains a point.
Vec3 in_plane_of(const Viewport& viewport, ImVec2 pointer, std::size_t pane, const Vec3& point) {
  const Ray ray = ray_at(viewport, pointer, pane);
  const Vec3 forward =
      (viewport.view.camera.target() - viewport.view.camera.eye(viewport.panes[pane])).normalized();
  const double towards = ray.direction.dot(forward);
  return ray.at((point - ray.origin).dot(forward) / towards);
}

void press(const Lab& lab, Viewport& viewport, ImVec2 pointer) {
  viewport.hand = {};
  viewport.hand.pane = pane_at(viewport, pointer);
  auto hit = body_at(lab, viewport, pointer, viewport.hand.pane);
  const bool moves = lab.session.playing();
  if (!hit && moves) hit = nearest_moving(lab, viewport, pointer, viewport.hand.pane);
  if (!hit) return;
  const auto i = static_cast<std::size_t>(hit->body);
  const Poses& poses = lab.poses_in(viewport.hand.pane);
  viewport.hand.body = hit->body;
  viewport.hand.point = ray_at(viewport, pointer, viewport.hand.pane).at(hit->distance);
  viewport.hand.anchor = poses.q[i].conjugate() * (viewport.hand.point - poses.x[i]);
}

// A press on a body drags it; elsewhere it orbits the view.
void drag(Session& session, Viewport& viewport) {
  const ImGuiIO& io = ImGui::GetIO();
  viewport.hand.pane =
      std::min(viewport.hand.pane, viewport.panes.size() - 1);  // a comparison may end meanwhile
  OrbitCamera& camera = viewport.view.camera;
  Hand& hand = viewport.hand;
  const bool moved = ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClick);
  hand.moved = hand.moved || moved;
  if (io.KeyShift || ImGui::IsMouseDown(ImGuiMouseButton_Right) ||
      ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
    camera.pan(static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y),
               viewport.panes[hand.pane]);
    return;
  }
  if (!hand.holding && hand.body >= 0 && can_be_held(session, hand.body)) {
    if (!moved) return;
    hand.holding = true;
    session.grab(hand.body, hand.anchor, hand.point);
  }
  if (hand.holding) {
    session.pull_to(in_plane_of(viewport, io.MousePos, hand.pane, hand.point));
  } else {
    camera.orbit(-0.007 * static_cast<double>(io.MouseDelta.x),
                 0.007 * static_cast<double>(io.MouseDelta.y));
  }
}

// Places the card on the side away from the body.
void select(Lab& lab, Desk& desk, const Viewport& viewport, int body) {
  if (desk.model.connecting) {
    desk.model.connecting = false;
    if (body >= 0) connect_selected(lab, desk, body);
    return;
  }
  if (body != desk.selected) desk.model.joint = -1;
  desk.selected = body;
  const ViewRect& v = viewport.view_rect;
  desk.card_left = ImGui::GetIO().MousePos.x > v.x + 0.5F * v.width;
}

void release(Lab& lab, Desk& desk, Viewport& viewport) {
  Hand& hand = viewport.hand;
  if (hand.holding) {
    lab.session.let_go();
  } else if (!hand.moved) {
    select(lab, desk, viewport, hand.body);
  }
  hand = {};
}

}  // namespace

void view_input(Lab& lab, Desk& desk, Viewport& viewport) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize(io.DisplaySize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::Begin("##view", nullptr,
               kPlaced | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  ImGui::InvisibleButton("picture", io.DisplaySize,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  if (ImGui::IsItemActivated()) {  // the motion of this frame precedes the press
    press(lab, viewport, io.MousePos);
  } else if (ImGui::IsItemActive()) {
    drag(lab.session, viewport);
  } else if (ImGui::IsItemDeactivated()) {
    release(lab, desk, viewport);
  }
  viewport.pointer_on_picture = ImGui::IsItemHovered();
  if (viewport.pointer_on_picture) {
    if (io.MouseWheel != 0.0F) {
      viewport.view.camera.zoom(std::pow(1.12, static_cast<double>(io.MouseWheel)));
    }
    const auto hit = viewport.hand.holding
                         ? std::nullopt
                         : body_at(lab, viewport, io.MousePos, pane_at(viewport, io.MousePos));
    if (viewport.hand.holding || (hit && can_be_held(lab.session, hit->body))) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    }
  }
  ImGui::End();
}

// Throws at the point under the pointer or, without a pointer, at the camera target. The ball is
// slow enough for its flight to be visible.
void throw_ball(Lab& lab, const Viewport& viewport) {
  constexpr double kFlight = 0.8;     // duration [s]
  constexpr double kDensity = 120.0;  // density of cork [kg/m^3]
  constexpr double kFull = 4.18879;   // volume of the unit ball
  const OrbitCamera& camera = viewport.view.camera;
  const Vec3 eye = camera.eye(viewport.panes.front());
  const double distance = (camera.target() - eye).norm();
  Vec3 aim = camera.target();
  if (viewport.pointer_on_picture) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const std::size_t pane = pane_at(viewport, pointer);
    const auto hit = body_at(lab, viewport, pointer, pane);
    aim = hit ? ray_at(viewport, pointer, pane).at(hit->distance)
              : in_plane_of(viewport, pointer, pane, camera.target());
  }
  Ball ball;
  ball.radius = std::clamp(0.016 * distance, 0.05, 0.6);
  ball.mass = kFull * kDensity * ball.radius * ball.radius * ball.radius;
  const Vec3 forward = (aim - eye).normalized();
  ball.position = eye + 0.3 * distance * forward - Vec3(0.0, 0.06 * distance, 0.0);
  const Scene& scene = lab.session.scene();
  ball.velocity = (aim - ball.position) / kFlight;
  if (scene.effects.gravity) ball.velocity -= 0.5 * kFlight * scene.gravity;
  lab.session.throw_ball(ball);
}

}  // namespace substep::ui
