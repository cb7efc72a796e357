// A run continued from a snapshot or a scene file is identical to an uninterrupted run.

#include <gtest/gtest.h>

#include "core/io/saved_scene.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

TEST(Resume, FromASnapshotIsBitIdentical) {
  for (const Scene& scene :
       {scenes::swinging_box(), scenes::bridge(), scenes::heavy_stack_stress()}) {
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
        const auto shared = std::make_shared<const Scene>(scene);
        Settings settings = scene.settings;
        settings.solver = solver;
        settings.policy = policy;
        settings.warm_start = true;
        Simulator whole(shared);
        whole.set_settings(settings);
        for (int i = 0; i < 40; ++i) whole.step();
        Simulator rest(shared);
        rest.set_settings(settings);
        rest.set_state(whole.state());
        for (int i = 0; i < 40; ++i) {
          whole.step();
          rest.step();
          ASSERT_EQ(state_hash(whole.state()), state_hash(rest.state())) << scene.name << " " << i;
        }
      }
    }
  }
}

/// The current state as a scene, written to a file and read again.
std::shared_ptr<const Scene> through_a_file(const Simulator& simulator) {
  const Scene saved = saved_scene(simulator.scene(), simulator.state(), simulator.settings());
  SceneResult read = read_scene(write_scene(saved));
  for (const Problem& problem : read.problems) ADD_FAILURE() << to_string(problem);
  return read.scene;
}

void expect_same_motion(const State& a, const State& b) {
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    ASSERT_EQ(a.x[i], b.x[i]) << i;
    ASSERT_EQ(a.q[i].coeffs(), b.q[i].coeffs()) << i;
    ASSERT_EQ(a.u[i], b.u[i]) << i;
  }
}

// With forces, stiffness and the last sub-step, which determine N, the bounds of friction, warm
// starts and the kicks of leapfrog.
TEST(Resume, FromASceneFileIsBitIdentical) {
  for (const Scene& scene : scenes::shipped()) {
    const auto shared = std::make_shared<const Scene>(scene);
    const bool small = scene.bodies.size() < 40;
    for (const Mode mode : small ? std::vector{Mode::kConst, Mode::kAdaptive, Mode::kStiffness}
                                 : std::vector{Mode::kAdaptive}) {
      for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
        for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
          SCOPED_TRACE(scene.name + " " + std::string(name_of(mode)) + " " +
                       std::string(name_of(solver)) + " " + std::string(name_of(integrator)));
          Settings settings = own_settings(scene);
          settings.mode = mode;
          settings.solver = solver;
          settings.integrator = integrator;
          settings.warm_start = solver == SolverKind::kPgs;
          settings.refinements = 2;  // of the stress stacks
          settings.detection =
              integrator == Integrator::kEuler ? Detection::kSubstep : Detection::kFrame;
          settings.islands = integrator == Integrator::kLeapfrog;
          settings.sleep = settings.islands;
          settings.n_max = 16;
          Simulator whole(shared);
          whole.set_settings(settings);
          FrameReport last;
          for (int i = 0; i < 30; ++i) last = whole.step();
          if (last.status != StepStatus::kOk) continue;  // within a frame, and not between two
          if (last.joint_gap > 0.09)
            continue;  // torn: a file may not start with joints this far open
          const auto saved = through_a_file(whole);
          ASSERT_NE(saved, nullptr);
          Simulator rest(saved);
          expect_same_motion(whole.state(), rest.state());
          for (int i = 0; i < 15; ++i) {
            const FrameReport a = whole.step();
            const FrameReport b = rest.step();
            ASSERT_EQ(a.n_substeps, b.n_substeps) << i;
            expect_same_motion(whole.state(), rest.state());
          }
        }
      }
    }
  }
}

/// A method that continues from more than forces and velocities.
struct Carrying {
  std::string name;
  Scene scene;
  void (*choose)(Settings&);
  bool (*carries)(const State&);  // whether its data is present
};

// Numerov's method continues from the rates of its forces, its velocities from the accelerations.
Carrying by_numerov(Scene scene) {
  return {"Numerov", std::move(scene),
          [](Settings& settings) {
            settings.solver = SolverKind::kNewton;
            settings.forces = Forces::kNumerov;
            settings.integrator = Integrator::kLeapfrog;
            settings.mode = Mode::kConst;
            settings.n = 16;
            settings.iterations = 1;
          },
          [](const State& state) {
            return !state.acceleration.empty() && state.forces.front().rate_change[0] != 0.0;
          }};
}

Carrying by_stormer(Scene scene) {
  return {"Stormer", std::move(scene),
          [](Settings& settings) { settings.integrator = Integrator::kStormer; },
          [](const State& state) {
            return !state.acceleration_change.empty() &&
                   !state.acceleration_change.back().isZero(0.0);
          }};
}

class WhatIsCarried : public testing::TestWithParam<Carrying> {};

INSTANTIATE_TEST_SUITE_P(Resume, WhatIsCarried,
                         testing::Values(by_numerov(scenes::swinging_box()),
                                         by_numerov(scenes::bridge()),
                                         by_stormer(scenes::swinging_box())),
                         [](const auto& of) { return of.param.name + "_" + of.param.scene.name; });

TEST_P(WhatIsCarried, ContinuesFromASceneFileBitForBit) {
  const auto& [name, scene, choose, carries] = GetParam();
  Settings settings = own_settings(scene);
  choose(settings);
  Simulator whole(std::make_shared<const Scene>(scene));
  whole.set_settings(settings);
  for (int i = 0; i < 30; ++i) whole.step();
  ASSERT_TRUE(carries(whole.state()));
  const auto saved = through_a_file(whole);
  ASSERT_NE(saved, nullptr);
  Simulator rest(saved);
  for (int i = 0; i < 15; ++i) {
    whole.step();
    rest.step();
    expect_same_motion(whole.state(), rest.state());
  }
}

TEST(Resume, AnotherLoadOrStartIsAnotherRun) {
  Simulator simulator(std::make_shared<const Scene>(scenes::swinging_box()));
  for (int i = 0; i < 3; ++i) simulator.step();
  const Scene saved = saved_scene(simulator.scene(), simulator.state(), simulator.settings());
  EXPECT_TRUE(start_of(saved, 1.0, 0).carried.has_value());
  EXPECT_FALSE(start_of(saved, 2.0, 0).carried.has_value());
  EXPECT_FALSE(start_of(saved, 1.0, 7).carried.has_value());
}

TEST(Resume, ResetIsTheStart) {
  const auto shared = std::make_shared<const Scene>(scenes::bridge());
  Simulator simulator(shared);
  for (int i = 0; i < 30; ++i) simulator.step();
  const std::uint64_t once = state_hash(simulator.state());
  simulator.reset();
  for (int i = 0; i < 30; ++i) simulator.step();
  EXPECT_EQ(state_hash(simulator.state()), once);
}

}  // namespace
}  // namespace substep::test
