// Two threads use one simulation at the same time, under a data-race detector: const_calls reads,
// const_calls steps. Const calls may overlap; a step may not, so `steps` shows that the detector
// works.

#include <cstdio>
#include <memory>
#include <string_view>
#include <thread>

#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

/// Two links and a slider that hang and swing into a floor: all kinds of joints, contact and
/// friction.
std::shared_ptr<const Scene> swing() {
  SceneBuilder builder;
  builder.body(builder.add_fixed(Plane{}, {0.0, -2.0, 0.0})).friction = 0.4;
  const int first = builder.add_body(Box{{0.5, 0.1, 0.1}}, 1.0, {0.5, 0.0, 0.0});
  const int second = builder.add_body(Box{{0.5, 0.1, 0.2}}, 2.0, {1.5, 0.0, 0.0});
  const int ball = builder.add_body(Sphere{0.3}, 5.0, {2.3, -1.75, 0.0});
  builder.body(ball).friction = 0.4;
  builder.add_hinge(first, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_ball_joint(second, first, {1.0, 0.0, 0.0});
  builder.add_prismatic(ball, second, {2.0, 0.0, 0.0}, Vec3::UnitY());
  builder.scene().settings.watch_stiffness = true;
  return builder.build();
}

double ask(const Simulator& simulator) {
  double sum = 0.0;
  for (int i = 0; i < 5; ++i) {
    const FrameReport report = simulator.observe();
    sum += report.energy + report.joint_gap + report.penetration;
    const ConstraintForces forces = simulator.constraint_forces();
    for (const JointForce& joint : forces.joints) sum += joint.force.norm() + joint.torque.norm();
    for (const ContactForce& contact : forces.contacts) sum += contact.force.norm();
    sum += simulator.state().x[1].norm() + simulator.settings().alpha;
    sum += static_cast<double>(simulator.substeps_left() + std::ssize(simulator.problems()));
  }
  return sum;
}

int run(bool steps) {
  Simulator simulator(swing());
  for (int i = 0; i < 20; ++i) {
    if (simulator.step().status != StepStatus::kOk) return 2;
  }
  double found[2] = {};
  std::thread other([&] {
    if (steps) simulator.step();
    found[1] = ask(simulator);
  });
  found[0] = ask(simulator);
  other.join();
  std::printf("%.17g %.17g\n", found[0], found[1]);
  return steps || found[0] == found[1] ? 0 : 1;
}

}  // namespace
}  // namespace substep

int main(int argc, char** argv) {
  return substep::run(argc > 1 && std::string_view(argv[1]) == "steps");
}
