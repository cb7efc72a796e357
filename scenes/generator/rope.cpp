#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

/// Appends the hinges and bodies of a rope that hangs from its anchor along (sin, -cos, 0) of its
/// angle.
void add_rope(const RopeOptions& options, Scene& scene) {
  const Vec3 d{options.angle.sine, -options.angle.cosine, 0.0};
  const double l = options.link_length;
  const double width = options.link_width;
  const double size = options.box_size;

  const auto hang = [&](Body body, double centre, double half_length, double parent_half_length) {
    body.position = options.anchor + d * centre;
    body.orientation = turn_about_z(d.x(), d.y());
    HingeJoint hinge;
    hinge.name = "hinge_" + std::to_string(scene.joints.size());
    hinge.a = static_cast<int>(scene.bodies.size());
    hinge.anchor_a = {-half_length, 0.0, 0.0};
    if (scene.joints.empty()) {
      hinge.b = kWorld;
      hinge.anchor_b = options.anchor;
    } else {
      hinge.b = hinge.a - 1;
      hinge.anchor_b = {parent_half_length, 0.0, 0.0};
    }
    hinge.compliance = options.compliance;
    hinge.angular_compliance = options.compliance;
    scene.bodies.push_back(std::move(body));
    scene.joints.emplace_back(hinge);
  };
  for (int i = 0; i < options.n; ++i) {
    hang(solid("link_" + std::to_string(i), box(l, width, width), options.link_mass, Vec3::Zero()),
         l * (i + 0.5), 0.5 * l, 0.5 * l);
  }
  hang(solid("box", box(size, size, size), options.end_mass, Vec3::Zero()),
       l * options.n + 0.5 * size, 0.5 * size, 0.5 * l);
  scene.criteria.track = static_cast<int>(scene.bodies.size()) - 1;
}

/// Potential energy that a straight rope releases between its initial angle and the vertical [J].
double fall(const Scene& scene, const RopeOptions& options) {
  double moment = 0.0;  // of its masses about the anchor [kg m]
  for (const Body& body : scene.bodies) {
    moment += body.mass * (body.position - options.anchor).norm();
  }
  return scene.gravity.norm() * moment * (1.0 - options.angle.cosine);
}

}  // namespace

Scene rope_of_n(const RopeOptions& options) {
  const double length = options.n * options.link_length + options.box_size;
  Scene scene = paper_scene();
  scene.name = "rope_of_" + std::to_string(options.n);
  scene.title = "Rope of " + std::to_string(options.n);
  scene.group = "playground";
  scene.description =
      std::to_string(options.n) + " hinged links with a heavy box at the end, released at rest.";
  scene.look_for = "The number of sub-steps that the light links need, and the cost of one.";
  scene.effects = {.gravity = true, .joints = true};
  scene.camera.eye = options.anchor + Vec3(0.0, -0.5 * length, 2.0 * length);
  scene.camera.target = options.anchor + Vec3(0.0, -0.5 * length, 0.0);
  add_rope(options, scene);
  const double freed = fall(scene, options);
  if (freed > 0.0) scene.criteria.energy_gain = 0.1 * freed;  // more is unphysical
  return scene;
}

Scene swinging_box(const SwingingBoxOptions& options) {
  Scene scene = paper_scene();
  scene.name = "swinging_box";
  scene.title = "Swinging box";
  scene.group = "paper";
  scene.description = "A box of 1000 kg swings on a chain of 25 links of 1 kg each.";
  scene.look_for =
      "Without sub-steps the chain tears at once. Adaptive sub-stepping takes most sub-steps at "
      "the bottom of the swing, where the tension is largest.";
  scene.effects = {.gravity = true, .joints = true};
  scene.criteria.energy_gain = 5150.0;
  scene.criteria.energy_scale = 51500.0;
  scene.camera.eye = {16.0, 9.0, 15.9};
  scene.camera.target = {1.7, 6.0, 0.0};
  scene.bodies.push_back(floor_plane());
  add_rope({.compliance = options.compliance, .angle = options.angle, .anchor = {0.0, 12.0, 0.0}},
           scene);
  return scene;
}

}  // namespace substep::scenes
