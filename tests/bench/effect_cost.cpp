// Runs a scene with one effect switched off, to be measured by an instruction counter.
//   effect_cost SCENE EFFECT off|absent
// off: the scene does not need the effect, but still has the data that only the effect reads
// (joints, friction coefficients, ...). absent: the scene has none of that data either, as if the
// effect did not exist.

#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "core/sim/simulator.hpp"
#include "scenes/generator/scenes.hpp"

namespace {

using namespace substep;

struct Effect {
  const char* name;
  bool Effects::*listed;
  void (*remove)(Scene&);
};

constexpr Effect kRemovals[] = {
    {"gravity", &Effects::gravity, [](Scene& scene) { scene.gravity = Vec3::Zero(); }},
    {"gyroscopic", &Effects::gyroscopic, [](Scene&) {}},
    {"joints", &Effects::joints, [](Scene& scene) { scene.joints.clear(); }},
    {"contact", &Effects::contact,
     [](Scene& scene) {
       scene.contact = {};
       scene.effects.friction = scene.effects.restitution = false;
     }},
    {"friction", &Effects::friction,
     [](Scene& scene) {
       for (Body& body : scene.bodies) body.friction = 0.0;
     }},
    {"restitution", &Effects::restitution,
     [](Scene& scene) {
       for (Body& body : scene.bodies) body.restitution = 0.0;
     }},
    {"external", &Effects::external,
     [](Scene& scene) {
       for (Body& body : scene.bodies) body.force = body.torque = Vec3::Zero();
     }},
};

constexpr int kFrames = 240;  // so that building the scene does not count

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: effect_cost SCENE EFFECT off|absent\n");
    return 2;
  }
  for (Scene& scene : scenes::shipped()) {
    if (scene.name != argv[1]) continue;
    for (const Effect& effect : kRemovals) {
      if (effect.name != std::string(argv[2])) continue;
      if (!(scene.effects.*effect.listed)) return 2;
      scene.effects.*effect.listed = false;
      if (effect.listed == &Effects::contact) {
        scene.effects.friction = scene.effects.restitution = false;  // they depend on it
      }
      if (argv[3] == std::string("absent")) effect.remove(scene);
      Simulator simulator(std::make_shared<const Scene>(std::move(scene)));
      for (int i = 0; i < kFrames; ++i) simulator.step();
      return 0;
    }
  }
  return 2;
}
