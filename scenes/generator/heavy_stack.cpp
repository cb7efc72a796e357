#include <cstdint>
#include <string>

#include "core/math/random.hpp"
#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr double kStackBallRadius = 0.15;  // of a ball [m]
constexpr double kStackPlate = 0.05;       // thickness of a plate [m]
constexpr double kJitter = 0.002;          // of the balls in the stress stacks [m]
constexpr std::uint64_t kSeed = 2024;      // of the jitter

void add_layer(int layer, double bottom, double jitter, Random& random, Scene& scene) {
  const std::string number = std::to_string(layer);
  int corner = 0;
  for (const double x : {-0.5, 0.5}) {
    for (const double z : {-0.5, 0.5}) {
      const double dx = jitter * random.next();
      const double dz = jitter * random.next();
      scene.bodies.push_back(solid("ball_" + number + "_" + std::to_string(corner++),
                                   Sphere{kStackBallRadius}, 1.0,
                                   {x + dx, bottom + kStackBallRadius, z + dz}));
    }
  }
  scene.bodies.push_back(solid("plate_" + number, box(1.6, kStackPlate, 1.6), 1.0,
                               {0.0, bottom + 2.0 * kStackBallRadius + 0.5 * kStackPlate, 0.0}));
}

}  // namespace

Scene heavy_stack(const HeavyStackOptions& options) {
  const double height = options.layers * (2.0 * kStackBallRadius + kStackPlate);
  const std::string layers = std::to_string(options.layers);
  const std::string tonnes = std::to_string(static_cast<int>(options.top_mass / 1000.0));
  Scene scene = paper_scene();
  scene.name = "heavy_stack";
  scene.title = "Heavy stack";
  scene.group = "paper";
  scene.description = layers + " layers of four balls and a plate, 1 kg each, carry a box of " +
                      tonnes + " t. Only contacts hold it.";
  scene.look_for =
      "It stands with any number of sub-steps, because the direct solver is exact in double "
      "precision. To see what sub-steps add, open its stress variant.";
  scene.effects = {.gravity = true, .contact = true};
  scene.contact.compliance = options.compliance;
  scene.settings.alpha = options.alpha;
  scene.camera.eye = {3.2, 0.5 * height + 1.8, 4.4 + 1.4 * height};
  scene.camera.target = {0.0, 0.54 * (height + 1.0), 0.0};
  if (options.stress) {
    scene.name = "heavy_stack_stress";
    scene.title = "Heavy stack, stress";
    scene.group = "stress";
    scene.description +=
        " The balls are displaced by up to 2 mm, and the solver's matrix has a fixed "
        "regularisation, as in single precision.";
    scene.look_for =
        "Without sub-steps the stack falls within a second; with more of them it stands longer. "
        "With refinements a single step is enough.";
    scene.regularisation = 7e-5;
  }
  scene.bodies.push_back(floor_plane());
  Random random(kSeed);
  for (int i = 0; i < options.layers; ++i) {
    add_layer(i, i * (2.0 * kStackBallRadius + kStackPlate), options.stress ? kJitter : 0.0, random,
              scene);
  }
  const int top = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(
      solid("box", box(1.0, 1.0, 1.0), options.top_mass, {0.0, height + 0.5, 0.0}));
  scene.criteria.displacement = Criteria::Displacement{top, 0.1};
  scene.criteria.track = top;
  return scene;
}

Scene heavy_stack_tall() {
  Scene scene = heavy_stack({.layers = 10, .top_mass = 20000.0, .alpha = 0.05});
  scene.name += "_tall";
  scene.title += ", tall";
  return scene;
}

Scene heavy_stack_stress() { return heavy_stack({.stress = true}); }

Scene heavy_stack_stress_tall() {
  Scene scene = heavy_stack({.layers = 10, .top_mass = 20000.0, .alpha = 0.05, .stress = true});
  scene.name += "_tall";
  scene.title += ", tall";
  return scene;
}

}  // namespace substep::scenes
