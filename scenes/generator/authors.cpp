// Scenes with the constants of the authors' public program. The sizes of the other shipped scenes
// of the paper are ours, because the paper gives none.

#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr const char* kWhose = " The sizes and masses of the authors' public program.";

}  // namespace

Scene swinging_box_authors() {
  constexpr int kLinks = 18;
  constexpr double kLength = 1.5;  // of a link [m]
  constexpr double kBox = 4.0;     // [m]
  Scene scene = paper_scene();
  scene.name = "swinging_box_authors";
  scene.title = "Swinging box, authors' constants";
  scene.group = "authors";
  scene.description =
      std::string("A box of 1000 kg hangs on a chain of 18 links of 1 kg and starts at 10 m/s.") +
      kWhose;
  scene.look_for =
      "Long links have more inertia: half as many sub-steps as for the swinging box with 25 short "
      "links are enough.";
  scene.effects = {.gravity = true, .joints = true};
  scene.criteria.energy_gain = 5000.0;
  scene.criteria.energy_scale = 50000.0;  // of the box's start
  scene.camera.eye = {52.0, 25.0, 36.0};
  scene.camera.target = {0.0, 17.0, 0.0};
  scene.bodies.push_back(floor_plane());
  const Vec3 anchor{0.0, 36.0, 0.0};
  double above = 0.0;  // half the height of what hangs above [m]
  double y = anchor.y();
  const auto hang = [&](Body body, double half) {
    HingeJoint hinge;
    hinge.name = "hinge_" + std::to_string(scene.joints.size());
    hinge.a = static_cast<int>(scene.bodies.size());
    hinge.b = scene.joints.empty() ? kWorld : hinge.a - 1;
    hinge.anchor_a = {0.0, half, 0.0};
    hinge.anchor_b = scene.joints.empty() ? anchor : Vec3{0.0, -above, 0.0};
    hinge.axis_a = hinge.axis_b = Vec3::UnitX();
    hinge.compliance = hinge.angular_compliance = 1e-12;
    body.position = {0.0, y - half, 0.0};
    scene.bodies.push_back(std::move(body));
    scene.joints.emplace_back(hinge);
    above = half;
    y -= 2.0 * half;
  };
  for (int i = 0; i < kLinks; ++i) {
    hang(solid("link_" + std::to_string(i), box(0.25, kLength, 0.25), 1.0, Vec3::Zero()),
         0.5 * kLength);
  }
  Body heavy = solid("box", box(kBox, kBox, kBox), 1000.0, Vec3::Zero());
  heavy.velocity = {0.0, 0.0, 10.0};
  scene.start = StartPolicy::kKeep;  // the authors' program gives the box a speed, not the chain
  hang(std::move(heavy), 0.5 * kBox);
  scene.criteria.track = static_cast<int>(scene.bodies.size()) - 1;
  return scene;
}

Scene bridge_authors() {
  constexpr int kPlanks = 20;
  constexpr double kPitch = 0.6;   // distance of two planks [m]
  constexpr double kHeight = 6.0;  // [m]
  constexpr double kMu = 0.8;
  Scene scene = paper_scene();
  scene.name = "bridge_authors";
  scene.title = "Bridge, authors' constants";
  scene.group = "authors";
  scene.description = std::string(
                          "A ball of 1000 kg falls on a bridge of 20 planks of 1 kg that "
                          "starts straight, and rolls along it.") +
                      kWhose;
  scene.look_for =
      "A straight chain cannot sag: it carries the ball only by the compliance of its joints, at a "
      "tension of 100 kN and more.";
  scene.effects = {.gravity = true, .joints = true, .contact = true, .friction = true};
  scene.contact.compliance = 1e-7;
  scene.contact.friction_compliance = 1e-10;
  scene.criteria.duration = 6.0;
  scene.camera.eye = {0.0, 8.0, 20.0};
  scene.camera.target = {0.0, 4.5, 0.0};
  scene.bodies.push_back(floor_plane());
  scene.bodies.back().friction = kMu;
  const auto place = [](int i) { return kPitch * (i - 0.5 * (kPlanks - 1)); };
  for (int i = 0; i < kPlanks; ++i) {
    Body plank =
        solid("plank_" + std::to_string(i), box(0.5, 0.1, 1.0), 1.0, {place(i), kHeight, 0.0});
    plank.friction = kMu;
    plank.collision_group = 0;
    scene.bodies.push_back(std::move(plank));
  }
  constexpr double kEnd = 0.5 * kPitch;
  join_planks(kPlanks, kPitch, 0.5, {place(0) - kEnd, kHeight, 0.0},
              {place(kPlanks - 1) + kEnd, kHeight, 0.0}, scene);

  Body ball = solid("ball", Sphere{0.5}, 1000.0, {place(0), kHeight + 1.0, 0.0});
  ball.velocity = {1.0, 0.0, 0.0};
  ball.angular_velocity = {0.0, 0.0, -5.0};
  ball.friction = kMu;
  scene.criteria.track = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(std::move(ball));
  return scene;
}

Scene heavy_stack_authors() {
  constexpr int kLayers = 4;
  constexpr double kRadius = 0.5;  // of a ball [m]
  constexpr double kPlate = 0.5;   // thickness [m]
  Scene scene = paper_scene();
  scene.name = "heavy_stack_authors";
  scene.title = "Heavy stack, authors' constants";
  scene.group = "authors";
  scene.description =
      std::string(
          "Four layers of four balls with plates between them, 1 kg each, carry a slab of "
          "20 t.") +
      kWhose;
  scene.look_for = "Wide and low: here a stack falls only by the residual of the solver.";
  scene.effects = {.gravity = true, .contact = true};
  scene.contact.compliance = 1e-12;
  scene.camera.eye = {11.0, 8.0, 22.0};
  scene.camera.target = {0.0, 3.0, 0.0};
  scene.bodies.push_back(floor_plane());
  double y = 0.0;
  for (int layer = 0; layer < kLayers; ++layer) {
    const std::string number = std::to_string(layer);
    int corner = 0;
    for (const double x : {-4.0, 4.0}) {
      for (const double z : {-4.0, 4.0}) {
        scene.bodies.push_back(solid("ball_" + number + "_" + std::to_string(corner++),
                                     Sphere{kRadius}, 1.0, {x, y + kRadius, z}));
      }
    }
    y += 2.0 * kRadius;
    if (layer + 1 == kLayers) break;
    scene.bodies.push_back(
        solid("plate_" + number, box(10.0, kPlate, 10.0), 1.0, {0.0, y + 0.5 * kPlate, 0.0}));
    y += kPlate;
  }
  const int top = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(solid("slab", box(15.0, 1.0, 15.0), 20000.0, {0.0, y + 0.5, 0.0}));
  scene.criteria.displacement = Criteria::Displacement{top, 0.1};
  scene.criteria.track = top;
  return scene;
}

}  // namespace substep::scenes
