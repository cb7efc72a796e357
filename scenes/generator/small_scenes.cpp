// Small scenes with a closed form.

#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {

Scene pendulum() {
  Scene scene = paper_scene();
  scene.name = "pendulum";
  scene.title = "Pendulum";
  scene.group = "exact";
  scene.description =
      "A rod of 1 m on a hinge, released 36.87 degrees from the vertical (sine 3/5).";
  scene.look_for = "The period is 1.682 s; the amplitude is constant.";
  scene.effects = {.gravity = true, .joints = true};
  scene.camera.eye = {0.0, 1.5, 3.2};
  scene.camera.target = {0.0, 1.4, 0.0};
  scene.criteria.track = 0;

  const Vec3 pivot{0.0, 2.0, 0.0};
  const Vec3 down{0.6, -0.8, 0.0};
  Body rod = solid("rod", box(1.0, 0.05, 0.05), 1.0, pivot + 0.5 * down);
  rod.orientation = turn_about_z(down.x(), down.y());
  scene.bodies.push_back(rod);

  HingeJoint hinge;
  hinge.name = "hinge";
  hinge.a = 0;
  hinge.anchor_a = {-0.5, 0.0, 0.0};
  hinge.anchor_b = pivot;
  hinge.compliance = 1e-12;
  hinge.angular_compliance = 1e-12;
  scene.joints.emplace_back(hinge);
  return scene;
}

Scene spinning_top() {
  Scene scene = paper_scene();
  scene.name = "spinning_top";
  scene.title = "Spinning top";
  scene.group = "exact";
  scene.description =
      "A free block rotates about its intermediate axis, without gravity: the Dzhanibekov effect.";
  scene.look_for = "It flips over again and again; energy and angular momentum are conserved.";
  scene.effects = {.gyroscopic = true};
  scene.criteria.track = 0;
  scene.criteria.duration = 20.0;
  scene.camera.eye = {1.4, 1.9, 2.4};
  scene.camera.target = {0.0, 1.0, 0.0};
  Body top = solid("block", box(1.0, 0.6, 0.2), 12.0, {0.0, 1.0, 0.0});
  top.angular_velocity = {0.0, 6.0, 0.05};
  scene.bodies.push_back(top);
  return scene;
}

Scene bouncing_balls() {
  Scene scene = paper_scene();
  scene.name = "bouncing_balls";
  scene.title = "Bouncing balls";
  scene.group = "exact";
  scene.description =
      "Five balls fall 2 m onto a floor. Their coefficients of restitution are 1, 0.9, 0.7, 0.5 "
      "and 0.";
  scene.look_for =
      "The first ball keeps its height; the first rebounds of the others reach 81 %, 49 %, 25 % "
      "and 0 % of it.";
  scene.effects = {.gravity = true, .contact = true, .restitution = true};
  scene.contact.compliance = 1e-16;  // compliance at an impact takes away speed
  scene.criteria.track = 1;
  scene.camera.eye = {0.0, 1.9, 6.6};
  scene.camera.target = {0.0, 1.2, 0.0};
  scene.bodies.push_back(floor_plane());
  constexpr double kRadius = 0.2;
  double x = -1.6;
  for (const double e : {1.0, 0.9, 0.7, 0.5, 0.0}) {
    Body ball = solid("ball_" + std::to_string(scene.bodies.size()), Sphere{kRadius}, 1.0,
                      {x, 2.0 + kRadius, 0.0});
    ball.restitution = e;
    scene.bodies.push_back(ball);
    x += 0.8;
  }
  return scene;
}

Scene newtons_cradle() {
  constexpr int kBalls = 5;
  constexpr double kRadius = 0.1;
  constexpr double kLength = 1.0;
  // Without gaps an impact would hit all of them at once, and its distribution would not be unique.
  constexpr double kGap = 0.004;
  constexpr double kPitch = 2.0 * kRadius + kGap;
  constexpr double kTop = 1.25;

  Scene scene = paper_scene();
  scene.name = "newtons_cradle";
  scene.title = "Newton's cradle";
  scene.group = "exact";
  scene.description =
      "Five equal balls on rods of 1 m, 4 mm apart; the first is released 36.87 degrees from the "
      "vertical. Impacts are elastic.";
  scene.look_for =
      "One in, one out: the impulse passes from ball to ball without loss. Impacts within a step "
      "are solved in sequence, so that one step per frame is enough.";
  scene.effects = {.gravity = true, .joints = true, .contact = true, .restitution = true};
  scene.settings.mode = Mode::kConst;
  scene.settings.n = 32;  // in a step no ball moves by more than a third of the gap
  scene.settings.integrator = Integrator::kLeapfrog;
  scene.contact.compliance = 1e-16;  // compliance at an impact takes away speed
  scene.criteria.track = kBalls;
  scene.camera.eye = {0.9, 1.0, 3.0};
  scene.camera.target = {0.0, 0.7, 0.0};
  const double width = (kBalls - 1) * kPitch;
  Body beam;
  beam.name = "beam";
  beam.shape = box(width + 0.3, 0.04, 0.04);
  beam.position = {0.0, kTop + 0.02, 0.0};
  beam.is_static = true;
  scene.bodies.push_back(beam);
  for (int i = 0; i < kBalls; ++i) {
    const Vec3 pivot{i * kPitch - 0.5 * width, kTop, 0.0};
    const double aside = i == 0 ? -0.6 : 0.0;
    const double below = i == 0 ? 0.8 : 1.0;
    Body ball = solid("ball_" + std::to_string(i + 1), Sphere{kRadius}, 1.0,
                      pivot + kLength * Vec3(aside, -below, 0.0));
    ball.orientation = turn_about_z(below, aside);
    ball.restitution = 1.0;
    HingeJoint rod;
    rod.name = "rod_" + std::to_string(i + 1);
    rod.a = static_cast<int>(scene.bodies.size());
    rod.anchor_a = {0.0, kLength, 0.0};
    rod.anchor_b = pivot;
    rod.compliance = 1e-12;
    rod.angular_compliance = 1e-12;
    scene.bodies.push_back(std::move(ball));
    scene.joints.emplace_back(rod);
  }
  return scene;
}

Scene sliding_box(const SlopeOptions& options) {
  const double sine = options.fall / options.length;
  const double cosine = options.run / options.length;
  const Vec3 along{cosine, -sine, 0.0};
  const Vec3 normal{sine, cosine, 0.0};
  const Vec3 middle{0.0, 1.0, 0.0};
  const double edge = 0.5;

  Scene scene = paper_scene();
  scene.name = "sliding_box";
  scene.title = "Sliding box";
  scene.group = "exact";
  scene.description = "A box on a slope of 5 in 12 with a friction coefficient of 0.3.";
  scene.look_for =
      "It slides down with 1.056 m/s^2. Above a coefficient of 5/12 it would not move.";
  scene.effects = {.gravity = true, .contact = true, .friction = true};
  scene.criteria.duration = 2.0;
  scene.criteria.track = 1;
  scene.camera.eye = {0.0, 2.2, 6.0};
  scene.camera.target = {0.0, 1.2, 0.0};

  Body slope = floor_plane();
  slope.name = "slope";
  slope.position = middle;
  slope.orientation = turn_about_z(cosine, -sine);
  slope.friction = options.friction;
  Body box_on_it =
      solid("box", box(edge, edge, edge), 1.0, middle - 1.5 * along + 0.5 * edge * normal);
  box_on_it.orientation = slope.orientation;
  box_on_it.friction = options.friction;
  scene.bodies = {slope, box_on_it};
  return scene;
}

Scene free_fall() {
  Scene scene = paper_scene();
  scene.name = "free_fall";
  scene.title = "Free fall";
  scene.group = "exact";
  scene.description = "One ball, released at a height of 20 m.";
  scene.look_for = "It falls 19.62 m in 2 s; one sub-step per frame is enough.";
  scene.effects = {.gravity = true};
  scene.criteria.duration = 2.0;
  scene.criteria.track = 0;
  scene.camera.eye = {0.0, 11.0, 26.0};
  scene.camera.target = {0.0, 10.0, 0.0};
  scene.bodies.push_back(solid("ball", Sphere{0.5}, 1.0, {0.0, 20.0, 0.0}));
  return scene;
}

}  // namespace substep::scenes
