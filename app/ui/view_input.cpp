// The picture is touched: turned, moved and zoomed, and its bodies selected, held and thrown at.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/render/picking.hpp"
#include "app/ui/panels.hpp"

namespace substep::ui {
namespace {

constexpr float kClick = 4.0F;  // a pointer that moves less is a click [px]

// The pane under a point of the display; the first where there is none.
std::size_t pane_at(const App& app, ImVec2 p) {
  for (std::size_t i = 1; i < app.panes.size(); ++i) {
    const ViewRect& r = app.panes[i];
    if (p.x >= r.x && p.x < r.x + r.width && p.y >= r.y && p.y < r.y + r.height) return i;
  }
  return 0;
}

Ray ray_at(const App& app, ImVec2 p, std::size_t pane) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  return ray_through(app.pictures[pane].view_projection.cast<double>(),
                     2.0 * static_cast<double>(p.x / display.x) - 1.0,
                     1.0 - 2.0 * static_cast<double>(p.y / display.y));
}

// What is under the pointer, or close by: links are thin and fingers are not.
std::optional<Hit> body_at(const App& app, ImVec2 p, std::size_t pane) {
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
    const Ray ray = ray_at(app, {p.x + near * d.x, p.y + near * d.y}, pane);
    if (const auto hit = first_hit(ray, app.scene_in(pane), app.poses_in(pane))) return hit;
  }
  return std::nullopt;
}

bool can_be_held(const App& app, int body) {
  const auto& bodies = app.session.scene().bodies;
  const auto i = static_cast<std::size_t>(body);
  return app.session.playing() && i < bodies.size() && !bodies[i].is_static;
}

// Where the pointer is in the plane that faces the view and holds a point.
Vec3 in_plane_of(const App& app, ImVec2 pointer, std::size_t pane, const Vec3& point) {
  const Ray ray = ray_at(app, pointer, pane);
  const Vec3 forward =
      (app.view.camera.target() - app.view.camera.eye(app.panes[pane])).normalized();
  const double towards = ray.direction.dot(forward);
  return ray.at((point - ray.origin).dot(forward) / towards);
}

void press(App& app, ImVec2 pointer) {
  app.hand = {};
  app.hand.pane = pane_at(app, pointer);
  const auto hit = body_at(app, pointer, app.hand.pane);
  if (!hit) return;
  const auto i = static_cast<std::size_t>(hit->body);
  const Poses& poses = app.poses_in(app.hand.pane);
  app.hand.body = hit->body;
  app.hand.point = ray_at(app, pointer, app.hand.pane).at(hit->distance);
  app.hand.anchor = poses.q[i].conjugate() * (app.hand.point - poses.x[i]);
}

// A body that was pressed is taken along, anything else turns the view.
void drag(App& app) {
  const ImGuiIO& io = ImGui::GetIO();
  app.hand.pane = std::min(app.hand.pane, app.panes.size() - 1);  // a comparison may end meanwhile
  OrbitCamera& camera = app.view.camera;
  Hand& hand = app.hand;
  const bool moved = ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClick);
  hand.moved = hand.moved || moved;
  if (io.KeyShift || ImGui::IsMouseDown(ImGuiMouseButton_Right) ||
      ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
    camera.pan(static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y),
               app.panes[hand.pane]);
    return;
  }
  if (!hand.holding && hand.body >= 0 && can_be_held(app, hand.body)) {
    if (!moved) return;
    hand.holding = true;
    app.session.grab(hand.body, hand.anchor, hand.point);
  }
  if (hand.holding) {
    app.session.pull_to(in_plane_of(app, io.MousePos, hand.pane, hand.point));
  } else {
    camera.orbit(-0.007 * static_cast<double>(io.MouseDelta.x),
                 0.007 * static_cast<double>(io.MouseDelta.y));
  }
}

// Its card goes where the body is not.
void select(App& app, int body) {
  app.desk.selected = body;
  const ViewRect& v = app.view_rect;
  app.desk.card_left = ImGui::GetIO().MousePos.x > v.x + 0.5F * v.width;
}

void release(App& app) {
  Hand& hand = app.hand;
  if (hand.holding) {
    app.session.let_go();
  } else if (!hand.moved) {
    select(app, hand.body);
  }
  hand = {};
}

}  // namespace

void view_input(App& app) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize(io.DisplaySize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::Begin("##view", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  ImGui::InvisibleButton("picture", io.DisplaySize,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  if (ImGui::IsItemActivated()) press(app, io.MousePos);
  if (ImGui::IsItemActive()) {
    drag(app);
  } else if (ImGui::IsItemDeactivated()) {
    release(app);
  }
  app.pointer_on_picture = ImGui::IsItemHovered();
  if (app.pointer_on_picture) {
    if (io.MouseWheel != 0.0F) {
      app.view.camera.zoom(std::pow(1.12, static_cast<double>(io.MouseWheel)));
    }
    const auto hit =
        app.hand.holding ? std::nullopt : body_at(app, io.MousePos, pane_at(app, io.MousePos));
    if (app.hand.holding || (hit && can_be_held(app, hit->body))) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    }
  }
  ImGui::End();
}

// From beside the eye to what the pointer is on, or to the middle of the view; it takes a moment,
// so that one sees it fly.
void throw_ball(App& app) {
  constexpr double kFlight = 0.8;     // [s]
  constexpr double kDensity = 120.0;  // of cork [kg/m^3]
  constexpr double kFull = 4.18879;   // volume of the unit ball
  const OrbitCamera& camera = app.view.camera;
  const Vec3 eye = camera.eye(app.panes.front());
  const double distance = (camera.target() - eye).norm();
  Vec3 aim = camera.target();
  if (app.pointer_on_picture) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const std::size_t pane = pane_at(app, pointer);
    const auto hit = body_at(app, pointer, pane);
    aim = hit ? ray_at(app, pointer, pane).at(hit->distance)
              : in_plane_of(app, pointer, pane, camera.target());
  }
  Ball ball;
  ball.radius = std::clamp(0.016 * distance, 0.05, 0.6);
  ball.mass = kFull * kDensity * ball.radius * ball.radius * ball.radius;
  const Vec3 forward = (aim - eye).normalized();
  ball.position = eye + 0.3 * distance * forward - Vec3(0.0, 0.06 * distance, 0.0);
  const Scene& scene = app.session.scene();
  ball.velocity = (aim - ball.position) / kFlight;
  if (scene.effects.gravity) ball.velocity -= 0.5 * kFlight * scene.gravity;
  app.session.throw_ball(ball);
}

}  // namespace substep::ui
