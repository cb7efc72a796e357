#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr int kLinks = 16;
constexpr double kWreckingLink = 0.3;    // length of a link [m]
constexpr double kWreckingRadius = 0.6;  // of the ball [m]
constexpr double kCrate = 0.5;           // edge of a crate [m]
constexpr double kWreckingMu = 0.5;
const Vec3 kAnchor{0.0, 6.3, 0.0};

/// A taut chain of ball joints with the ball at its end, released at 53 degrees (sine 4/5).
void add_chain(Scene& scene) {
  const Vec3 along{-0.8, -0.6, 0.0};
  const auto hang = [&](Body body, double centre, double half_length, double parent_half_length) {
    body.position = kAnchor + along * centre;
    body.orientation = turn_about_z(-along.x(), -along.y());
    body.friction = kWreckingMu;
    body.color = kIron;
    BallJoint joint;
    joint.name = "pivot_" + std::to_string(scene.joints.size());
    joint.a = static_cast<int>(scene.bodies.size());
    // The body's +x points up along the chain.
    joint.anchor_a = {half_length, 0.0, 0.0};
    if (scene.joints.empty()) {
      joint.b = kWorld;
      joint.anchor_b = kAnchor;
    } else {
      joint.b = joint.a - 1;
      joint.anchor_b = {-parent_half_length, 0.0, 0.0};
    }
    scene.bodies.push_back(std::move(body));
    scene.joints.emplace_back(joint);
  };
  for (int i = 0; i < kLinks; ++i) {
    hang(solid("link_" + std::to_string(i), box(kWreckingLink, 0.1, 0.1), 2.0, Vec3::Zero()),
         kWreckingLink * (i + 0.5), 0.5 * kWreckingLink, 0.5 * kWreckingLink);
  }
  hang(solid("ball", Sphere{kWreckingRadius}, 1000.0, Vec3::Zero()),
       kWreckingLink * kLinks + kWreckingRadius, kWreckingRadius, 0.5 * kWreckingLink);
  scene.criteria.track = static_cast<int>(scene.bodies.size()) - 1;
  scene.criteria.energy_scale = 21190.0;  // released by the fall of the ball
  scene.criteria.energy_gain = 2119.0;    // a tenth of it
}

}  // namespace

Scene wrecking_ball() {
  Scene scene = paper_scene();
  scene.name = "wrecking_ball";
  scene.title = "Wrecking ball";
  scene.group = "playground";
  scene.description =
      "A ball of 1000 kg on a chain of 16 light links swings into a tower of crates.";
  scene.look_for =
      "Each island has its own number of sub-steps: that of the chain rises with its tension, the "
      "tower takes one. The islands merge when the ball hits and split when crates fly off.";
  scene.effects = {
      .gravity = true, .gyroscopic = true, .joints = true, .contact = true, .friction = true};
  add_ground(kWreckingMu, 0.01, scene);
  add_chain(scene);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 2; ++x) {
      for (int z = 0; z < 3; ++z) {
        Body crate =
            solid("crate_" + std::to_string(6 * y + 3 * x + z), box(kCrate, kCrate, kCrate), 12.0,
                  {0.9 + kCrate * x, kCrate * (y + 0.5), kCrate * (z - 1)});
        crate.friction = kWreckingMu;
        crate.color = (x + y + z) % 2 == 0 ? kWood : kWoodDark;
        scene.bodies.push_back(crate);
      }
    }
  }
  scene.settings.islands = true;  // with one N for all, fallen crates make the chain gain energy
  // Centred between the initial ball on the left and the final position of the crates on the right:
  // the view extends equally to both sides.
  scene.camera.eye = {4.9, 3.6, 13.0};
  scene.camera.target = {1.3, 3.0, 0.0};
  return scene;
}

}  // namespace substep::scenes
