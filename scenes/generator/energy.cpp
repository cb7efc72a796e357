// Mechanisms that the paper's adaptive rule gives energy: their stiffness, and with it the number
// of sub-steps, rises and falls with the motion.

#include <cmath>
#include <string>
#include <utility>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

/// A bar in the plane z = 0 that moves with the rotation `omega` about z and with the velocity
/// `velocity` of its left end.
Body bar(std::string name, double length, double mass, const Vec3& left, const Vec3& direction,
         const Vec3& velocity, double omega) {
  const Vec3 arm = 0.5 * length * direction;
  Body body = solid(std::move(name), box(length, 0.05, 0.05), mass, left + arm);
  body.orientation = turn_about_z(direction.x(), direction.y());
  body.angular_velocity = {0.0, 0.0, omega};
  body.velocity = velocity + body.angular_velocity.cross(arm);
  return body;
}

/// A conservative scene, judged by its energy; it starts with the default settings.
Scene conservative(std::string name, std::string title) {
  Scene scene;
  scene.name = std::move(name);
  scene.title = std::move(title);
  scene.group = "energy";
  return scene;
}

}  // namespace

Scene crank_rocker() {
  constexpr double kCrank = 0.5;  // lengths [m]
  constexpr double kCoupler = 2.0;
  constexpr double kRocker = 1.5;
  constexpr double kGround = 2.0;
  constexpr double kSpeed = 30.0;  // of the crank [rad/s]

  Scene scene = conservative("crank_rocker", "Crank and rocker");
  scene.description =
      "A four-bar linkage without friction: a crank of 0.5 m starts at 30 rad/s and drives a "
      "rocker of 1.5 m through a coupler of 2 m.";
  scene.look_for =
      "The energy is constant. With the paper's preset N follows the motion and the energy grows; "
      "a smaller alpha is no cure.";
  scene.effects = {.gravity = true, .joints = true};
  scene.criteria.duration = 20.0;
  scene.criteria.window = 3.0;
  scene.camera.eye = {1.0, 0.9, 4.6};
  scene.camera.target = {1.0, 0.45, 0.0};

  // The crank stands at 60 degrees. Its end, the coupler's and the rocker's lengths and the second
  // pivot D define a triangle.
  const Vec3 along_crank{0.5, 0.5 * std::sqrt(3.0), 0.0};
  const Vec3 b = kCrank * along_crank;
  const Vec3 d{kGround, 0.0, 0.0};
  const double base = (d - b).norm();
  const Vec3 towards = (d - b) / base;
  const double foot = (kCoupler * kCoupler - kRocker * kRocker + base * base) / (2.0 * base);
  const double height = std::sqrt(kCoupler * kCoupler - foot * foot);
  const Vec3 c = b + foot * towards + height * Vec3(-towards.y(), towards.x(), 0.0);
  const Vec3 along_coupler = (c - b) / kCoupler;
  const Vec3 along_rocker = (d - c) / kRocker;

  // C moves with the coupler and across the rocker: its velocity along the rocker is zero.
  const Vec3 z = Vec3::UnitZ();
  const Vec3 velocity_b = kSpeed * z.cross(b);
  const double omega_coupler =
      -velocity_b.dot(along_rocker) / (kCoupler * z.cross(along_coupler).dot(along_rocker));
  const Vec3 velocity_c = velocity_b + omega_coupler * kCoupler * z.cross(along_coupler);
  const double omega_rocker = -velocity_c.dot(z.cross(along_rocker)) / kRocker;

  scene.bodies = {bar("crank", kCrank, 0.5, Vec3::Zero(), along_crank, Vec3::Zero(), kSpeed),
                  bar("coupler", kCoupler, 1.0, b, along_coupler, velocity_b, omega_coupler),
                  bar("rocker", kRocker, 1.0, c, along_rocker, velocity_c, omega_rocker)};
  const Vec3 x = Vec3::UnitX();
  scene.joints = {hinge_joint("A", 0, -0.5 * kCrank * x, kWorld, Vec3::Zero()),
                  hinge_joint("B", 1, -0.5 * kCoupler * x, 0, 0.5 * kCrank * x),
                  hinge_joint("C", 2, -0.5 * kRocker * x, 1, 0.5 * kCoupler * x),
                  hinge_joint("D", 2, 0.5 * kRocker * x, kWorld, d)};
  scene.criteria.track = 2;
  return scene;
}

Scene thrown_rope() {
  constexpr int kLinks = 8;
  constexpr double kLink = 0.25;   // [m]
  constexpr double kRadius = 0.1;  // of the ball [m]
  constexpr double kSpeed = 3.0;   // of the ball [m/s]

  Scene scene = conservative("thrown_rope", "Thrown rope");
  scene.description =
      "A ball of 5 kg on a rope of eight links of 50 g is thrown up at 3 m/s from the side of its "
      "anchor.";
  scene.look_for =
      "The rope goes slack and snaps taut again and again: N rises at once, within a frame. The "
      "energy is constant.";
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.criteria.duration = 10.0;
  scene.criteria.window = 2.0;  // later snaps amplify every error
  scene.camera.eye = {0.3, 0.3, 7.0};
  scene.camera.target = {0.3, -0.6, 0.0};

  const auto join = [&](int a, double arm) {
    scene.joints.emplace_back(ball_joint("joint_" + std::to_string(a), a, {-arm, 0.0, 0.0},
                                         a > 0 ? a - 1 : kWorld,
                                         {a > 0 ? 0.5 * kLink : 0.0, 0.0, 0.0}));
  };
  for (int i = 0; i < kLinks; ++i) {
    scene.bodies.push_back(solid("link_" + std::to_string(i), box(kLink, 0.04, 0.04), 0.05,
                                 {(i + 0.5) * kLink, 0.0, 0.0}));
    join(i, 0.5 * kLink);
  }
  Body ball = solid("ball", Sphere{kRadius}, 5.0, {kLinks * kLink + kRadius, 0.0, 0.0});
  ball.velocity = {0.0, kSpeed, 0.0};
  scene.bodies.push_back(ball);
  join(kLinks, kRadius);
  // The last link turns about its other end.
  Body& last = scene.bodies[kLinks - 1];
  last.velocity = {0.0, 0.5 * kSpeed, 0.0};
  last.angular_velocity = {0.0, 0.0, kSpeed / kLink};
  scene.criteria.track = kLinks;
  return scene;
}

}  // namespace substep::scenes
