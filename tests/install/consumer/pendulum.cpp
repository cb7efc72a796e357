#include <cstdio>

#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"

int main() {
  substep::SceneBuilder builder("pendulum");
  builder.add_fixed(substep::Plane{}, {0, 0, 0});
  const int rod = builder.add_body(substep::Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 2, 0});
  builder.add_hinge(rod, substep::kWorld, {0, 2, 0}, {0, 0, 1});

  substep::Simulator simulator(builder.build());
  for (int frame = 0; frame < 60; ++frame) {
    if (simulator.step().status == substep::StepStatus::kOk) continue;
    for (const substep::Problem& problem : simulator.problems()) {
      std::fprintf(stderr, "%s\n", to_code(problem).c_str());
    }
    return 1;
  }
  const substep::Vec3& centre = simulator.state().x[rod];
  std::printf("after %.0f s the rod is at (%.3f, %.3f) m\n", simulator.state().time, centre.x(),
              centre.y());
}
