// Bodies with unequal moments of inertia on ball joints, in three-dimensional motion: the
// gyroscopic torque and the joint forces interact. The exact motion is that of a joint tree.

#include <cmath>
#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

/// The shortest rotation from one unit vector to another, which must not be opposite.
Quat rotation_between(const Vec3& from, const Vec3& to) {
  // (1 + from . to, from x to) has twice the angle's half cosine and half sine as factors.
  const Vec3 v = from.cross(to);
  const double w = 1.0 + from.dot(to);
  const double length = std::sqrt(w * w + v.squaredNorm());
  return {w / length, v.x() / length, v.y() / length, v.z() / length};
}

/// Lets the body move as if it were fixed to a point.
/// @param omega world [rad/s] @param arm from that point to its centre, world [m]
void spin_about(const Vec3& omega, const Vec3& arm, Body& body) {
  body.angular_velocity = omega;
  body.velocity = omega.cross(arm);
}

Scene in_space(std::string name, std::string title) {
  Scene scene = paper_scene();
  scene.name = std::move(name);
  scene.title = std::move(title);
  scene.group = "exact";
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.criteria.duration = 10.0;
  return scene;
}

}  // namespace

Scene spherical_pendulum() {
  Scene scene = in_space("spherical_pendulum", "Spherical pendulum");
  scene.description =
      "A flat box of 2 kg on a ball joint at the end of its long axis, thrown sideways and "
      "spinning "
      "about that axis.";
  scene.look_for =
      "It swings in no fixed plane and turns over. Energy and the vertical angular momentum are "
      "conserved.";
  scene.criteria.track = 0;
  scene.camera.eye = {0.9, 2.4, 2.6};
  scene.camera.target = {0.0, 1.75, 0.0};

  const Vec3 pivot{0.0, 2.0, 0.0};
  const Vec3 d{0.6, -0.64, 0.48};  // a unit vector
  Body body = solid("box", box(0.8, 0.3, 0.1), 2.0, pivot + 0.4 * d);
  body.orientation = rotation_between(Vec3::UnitX(), d);
  spin_about(Vec3(0.0, 2.0, 0.0) + 4.0 * d, 0.4 * d, body);
  scene.bodies.push_back(body);
  scene.joints.emplace_back(ball_joint("pivot", 0, {-0.4, 0.0, 0.0}, kWorld, pivot));
  return scene;
}

Scene heavy_top() {
  Scene scene = in_space("heavy_top", "Heavy top");
  scene.description =
      "A square plate of 2 kg spins at 60 rad/s about its axis, 36.87 degrees from upright (sine "
      "3/5), 0.5 m from its fixed point.";
  scene.look_for =
      "It does not fall: it precesses once in 8 s and nutates a little more than three times per "
      "second.";
  scene.criteria.track = 0;
  scene.camera.eye = {1.6, 1.7, 2.4};
  scene.camera.target = {0.0, 0.8, 0.0};

  const Vec3 tip{0.0, 0.6, 0.0};
  const Vec3 axis{0.6, 0.8, 0.0};
  Body plate = solid("plate", box(0.8, 0.2, 0.8), 2.0, tip + 0.5 * axis);
  plate.orientation = rotation_between(Vec3::UnitY(), axis);
  plate.angular_velocity = 60.0 * axis;  // the centre is at rest
  scene.bodies.push_back(plate);
  scene.joints.emplace_back(ball_joint("tip", 0, {0.0, -0.5, 0.0}, kWorld, tip));
  return scene;
}

Scene whirling_chain() {
  constexpr int kLinks = 7;
  constexpr double kLink = 0.4;   // [m]
  constexpr double kBox = 0.6;    // along the chain [m]
  constexpr double kWhirl = 1.5;  // about the vertical [rad/s]
  constexpr double kTwist = 3.0;  // of the box about the chain [rad/s]

  Scene scene = in_space("whirling_chain", "Whirling chain");
  scene.description =
      "A box of 50 kg on a chain of seven links of 0.5 kg on ball joints, whirled around the "
      "vertical and twisted.";
  scene.look_for = "The box circles, rises and turns over.";
  scene.camera.eye = {3.5, 5.5, 7.5};
  scene.camera.target = {0.0, 3.4, 0.0};

  const Vec3 anchor{0.0, 5.0, 0.0};
  const Vec3 d{0.6, -0.8, 0.0};
  const Quat along = rotation_between(Vec3::UnitX(), d);
  double from_anchor = 0.0;  // of the next joint [m]
  const auto hang = [&](const std::string& name, const Box& shape, double mass, double twist) {
    const double half = shape.half_extents.x();
    const Vec3 arm = (from_anchor + half) * d;
    Body body = solid(name, shape, mass, anchor + arm);
    body.orientation = along;
    spin_about(Vec3(0.0, kWhirl, 0.0), arm, body);
    body.angular_velocity += twist * d;  // the joints lie on that axis
    const int i = static_cast<int>(scene.bodies.size());
    scene.joints.emplace_back(ball_joint("joint_" + std::to_string(i), i, {-half, 0.0, 0.0},
                                         i > 0 ? i - 1 : kWorld,
                                         i > 0 ? Vec3(0.5 * kLink, 0.0, 0.0) : anchor));
    scene.bodies.push_back(body);
    from_anchor += 2.0 * half;
  };
  for (int i = 0; i < kLinks; ++i) {
    hang("link_" + std::to_string(i), box(kLink, 0.1, 0.06), 0.5, 0.0);
  }
  hang("box", box(kBox, 0.5, 0.3), 50.0, kTwist);
  scene.criteria.track = kLinks;
  return scene;
}

}  // namespace substep::scenes
