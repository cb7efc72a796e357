// Only the effects that a scene calls for; what a frame reports; how a run fails.

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/generator/scenes.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

FrameReport first_frame(const Scene& scene, const Settings& settings = {}) {
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.set_settings(settings);
  return simulator.step();
}

TEST(Stages, AnEffectNotCalledForLeavesNoRowsAndNoTime) {
  const FrameReport chain = first_frame(scenes::swinging_box());
  EXPECT_TRUE(chain.stages.gravity && chain.stages.joints);
  EXPECT_FALSE(chain.stages.contact || chain.stages.friction || chain.stages.gyroscopic);
  EXPECT_EQ(chain.joint_rows, 130);
  EXPECT_EQ(chain.contact_rows, 0);
  EXPECT_EQ(chain.times.contact, 0.0);
  EXPECT_EQ(chain.times.friction, 0.0);

  const FrameReport stack = first_frame(scenes::heavy_stack());
  EXPECT_FALSE(stack.stages.joints || stack.stages.friction);
  EXPECT_EQ(stack.contact_rows, 44);
  EXPECT_EQ(stack.friction_rows, 0);
  EXPECT_EQ(stack.times.joints, 0.0);

  const FrameReport top = first_frame(scenes::spinning_top());
  EXPECT_TRUE(top.stages.gyroscopic);
  EXPECT_FALSE(top.stages.gravity || top.stages.joints || top.stages.contact);
}

TEST(Stages, StiffnessIsEvaluatedOnlyForAModeOrAViewThatReadsIt) {
  Settings settings;
  settings.mode = Mode::kConst;
  EXPECT_FALSE(first_frame(scenes::swinging_box(), settings).stages.stiffness);
  settings.watch_stiffness = true;
  EXPECT_TRUE(first_frame(scenes::swinging_box(), settings).stages.stiffness);
  EXPECT_TRUE(first_frame(scenes::swinging_box(), Settings{}).stages.stiffness);
}

TEST(Stages, FrictionRowsOnlyWhereBothBodiesHaveFriction) {
  Scene scene = scenes::bridge();
  EXPECT_GT(first_frame(scene).friction_rows, 0);
  for (Body& body : scene.bodies) {
    if (body.name == "ball") body.friction = 0.0;
  }
  EXPECT_EQ(first_frame(scene).friction_rows, 0);
}

TEST(Report, NamesWhoSetR) {
  const Scene scene = scenes::swinging_box();
  Simulator simulator(std::make_shared<const Scene>(scene));
  FrameReport report;
  for (int i = 0; i < 60; ++i) report = simulator.step();
  const auto& who = report.leader;
  ASSERT_GE(who.body, 0);
  EXPECT_GE(who.dof, 3) << "a rotation";
  const auto body = static_cast<std::size_t>(who.body);
  EXPECT_EQ(who.mass, scene.bodies[body].inertia[who.dof - 3]);
  EXPECT_EQ(who.k, simulator.state().k[body][who.dof]);
  EXPECT_DOUBLE_EQ(who.r, who.k / who.mass);
  EXPECT_DOUBLE_EQ(who.r, simulator.state().r);
  EXPECT_DOUBLE_EQ(report.dt_stable, 2.0 * std::sqrt(0.1 / who.r));
}

TEST(Report, TheCapIsReportedWhenItBites) {
  Settings settings;
  settings.n_max = 8;
  const FrameReport report = first_frame(scenes::swinging_box(), settings);
  EXPECT_EQ(report.n_substeps, 8);
  EXPECT_TRUE(report.capped);
  EXPECT_EQ(report.n_wanted, 10);
  EXPECT_FALSE(first_frame(scenes::swinging_box()).capped);
}

TEST(Report, TheProbeRunsOnTheFirstFrameOnly) {
  Simulator simulator(std::make_shared<const Scene>(scenes::swinging_box()));
  const FrameReport first = simulator.step();
  EXPECT_TRUE(first.stages.probe);
  EXPECT_EQ(first.n_substeps, 10);
  EXPECT_FALSE(simulator.step().stages.probe);
  Settings without;
  without.probe = false;
  EXPECT_EQ(first_frame(scenes::swinging_box(), without).n_substeps, 1) << "no force is known yet";
}

TEST(Report, TheProbeRunsAgainWhenAModeThatReadsStiffnessIsSwitchedOn) {
  Simulator simulator(std::make_shared<const Scene>(scenes::swinging_box()));
  Settings settings;
  settings.mode = Mode::kConst;
  simulator.set_settings(settings);
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(simulator.step().stages.probe);
  settings.mode = Mode::kAdaptive;
  simulator.set_settings(settings);
  const FrameReport first = simulator.step();
  EXPECT_TRUE(first.stages.probe);
  EXPECT_GE(first.n_substeps, 10);
}

// Two rigid joints on one pair of bodies: a singular system, not a number.
TEST(Failure, StopsAtTheLastFiniteStateAndSaysWho) {
  Scene scene = scenes::swinging_box({scenes::kSixtyDegrees, 0.0});
  scene.joints.push_back(scene.joints[3]);
  Simulator simulator(std::make_shared<const Scene>(scene));
  FrameReport report;
  for (int i = 0; i < 600 && report.status == StepStatus::kOk; ++i) report = simulator.step();
  ASSERT_EQ(report.status, StepStatus::kNotFinite);
  EXPECT_GE(report.failed_body, 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    EXPECT_TRUE(simulator.state().x[i].allFinite());
    EXPECT_TRUE(simulator.state().u[i].allFinite());
  }
  const std::uint64_t hash = state_hash(simulator.state());
  EXPECT_EQ(simulator.step().status, StepStatus::kNotFinite);
  EXPECT_EQ(state_hash(simulator.state()), hash);
  simulator.reset();
  EXPECT_EQ(simulator.observe().status, StepStatus::kOk);
}

// Complementarity of every frame's last solve, in scenes with and without friction.
TEST(Solves, AreComplementary) {
  EXPECT_LT(run(scenes::swinging_box(), Settings{}, 5.0).residual, 1e-9);
  const Outcome stack = run(scenes::heavy_stack_stress(), Settings{}, 5.0);
  EXPECT_LT(stack.residual, 1e-9);
  EXPECT_EQ(stack.unsolved, 0);
  // Friction bounds are refreshed four times a sub-step at most and go on settling in the next one:
  // the typical frame is settled, an impact need not be.
  std::vector<double> residuals;
  const Outcome bridge =
      run(scenes::bridge(), Settings{}, 3.0, [&](const Simulator&, const FrameReport& report) {
        residuals.push_back(report.work.residual);
      });
  EXPECT_EQ(bridge.unsolved, 0);
  EXPECT_LT(Outcome::median(residuals), 1e-6);
}

TEST(Modes, MayChangeWhileTheSceneRuns) {
  Simulator simulator(std::make_shared<const Scene>(scenes::bridge()));
  Settings settings;
  for (int i = 0; i < 120; ++i) {
    const int turn = i / 10;
    settings.solver = turn % 2 == 0 ? SolverKind::kBpp : SolverKind::kPgs;
    settings.integrator = turn % 3 == 0 ? Integrator::kLeapfrog : Integrator::kEuler;
    settings.policy = turn % 5 == 0 ? Policy::kSubstep : Policy::kFrame;
    settings.alpha = 0.05 + 0.01 * (turn % 7);
    simulator.set_settings(settings);
    const FrameReport report = simulator.step();
    ASSERT_EQ(report.status, StepStatus::kOk);
    ASSERT_LT(report.joint_gap, 0.1) << i;
  }
}

}  // namespace
}  // namespace substep::test
