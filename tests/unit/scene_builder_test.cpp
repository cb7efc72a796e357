// A scene built in a few lines of code is complete: derived values are filled in.

#include "core/model/scene_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/methods.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

TEST(SceneBuilder, FillsInInertiaEffectsAndNames) {
  SceneBuilder builder("built");
  const int floor = builder.add_fixed(Plane{}, {0, 0, 0});
  const int ball = builder.add_body(Sphere{0.5}, 2.0, {0, 0.5, 0});
  const int crate = builder.add_body(Box{{0.5, 0.25, 0.1}}, 3.0, {2, 1, 0});
  builder.add_ball_joint(crate, kWorld, {2, 2, 0});
  builder.body(ball).friction = builder.body(floor).friction = 0.5;
  const auto scene = builder.build();
  EXPECT_EQ(scene->bodies[index(ball)].inertia, solid_inertia(Sphere{0.5}, 2.0));
  EXPECT_EQ(scene->bodies[index(crate)].inertia, solid_inertia(Box{{0.5, 0.25, 0.1}}, 3.0));
  const Effects all{
      .gravity = true, .gyroscopic = true, .joints = true, .contact = true, .friction = true};
  EXPECT_EQ(scene->effects, all);
  EXPECT_TRUE(validate(*scene).empty());
  EXPECT_TRUE(read_scene(write_scene(*scene)).problems.empty());
}

TEST(SceneBuilder, KeepsTheInertiaThatIsGiven) {
  SceneBuilder builder;
  const int ball = builder.add_body(Sphere{0.5}, 2.0, {0, 0, 0});
  builder.body(ball).inertia = {1, 2, 2.5};
  EXPECT_EQ(builder.build()->bodies[0].inertia, Vec3(1, 2, 2.5));
}

TEST(SceneBuilder, JoinsRotatedBodiesAtACommonPoint) {
  SceneBuilder builder;
  const int a = builder.add_body(Box{}, 1.0, {1, 2, 3});
  const int b = builder.add_body(Box{}, 1.0, {-1, 0, 1});
  builder.body(a).orientation = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  builder.body(b).orientation = Quat(Eigen::AngleAxisd(-1.9, Vec3(3, -1, 1).normalized()));
  builder.add_hinge(a, b, {0.3, 1, 2}, {0, 2, 1});
  const auto scene = builder.build();
  EXPECT_TRUE(validate(*scene).empty());
  Simulator simulator(scene);
  EXPECT_TRUE(simulator.start().found.consistent());
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

TEST(SceneBuilder, ASceneInWhichNothingMovesStaysWithEveryMethod) {
  SceneBuilder builder;
  builder.add_fixed(Plane{}, {0, 0, 0});
  builder.add_fixed(Box{}, {0, 0.2, 0});
  const auto scene = builder.build();
  EXPECT_TRUE(validate(*scene).empty());
  for (const auto& mode : kModes) {
    for (const auto& solver : kSolvers) {
      Simulator simulator(scene);
      Settings settings;
      settings.mode = mode.value;
      settings.solver = solver.value;
      simulator.set_settings(settings);
      for (int i = 0; i < 3; ++i) {
        const FrameReport& report = simulator.step();
        EXPECT_EQ(report.status, StepStatus::kOk) << mode.name << ' ' << solver.name;
        EXPECT_EQ(report.energy, 0.0);
        EXPECT_TRUE(std::isfinite(report.n_mean)) << mode.name << ' ' << solver.name;
      }
      EXPECT_EQ(simulator.state().x[1], Vec3(0, 0.2, 0));
    }
  }
}

TEST(SceneBuilder, LeavesProblemsToTheChecks) {
  SceneBuilder builder;
  builder.add_body(Sphere{0.5}, 0.0, {0, 0, 0});
  builder.add_ball_joint(0, 77, {0, 0, 0});
  Simulator simulator(builder.build());
  EXPECT_EQ(simulator.step().status, StepStatus::kInvalid);
  const Problems problems = simulator.problems();
  ASSERT_EQ(problems.size(), 5U);  // mass, three moments, joint
  EXPECT_EQ(problems.front().pointer, "/bodies/0/mass");
  EXPECT_EQ(problems.back().pointer, "/joints/0/b");
}

}  // namespace
}  // namespace substep
