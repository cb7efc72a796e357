// Only the effects that a scene needs; the report of a frame; failures of a run.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

FrameReport first_frame(const Scene& scene, const Settings& settings = {}) {
  return simulator_of(scene, settings).step();
}

TEST(Stages, AnUnlistedEffectHasNoRowsAndNoTime) {
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

  EXPECT_FALSE(stack.stages.restitution);
  EXPECT_TRUE(first_frame(scenes::bouncing_balls()).stages.restitution);

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

TEST(Report, UnmeasuredValuesAreNaNAndDoNotChangeTheMotion) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::heavy_stack()}) {
    Simulator all(std::make_shared<const Scene>(scene));
    Simulator none(std::make_shared<const Scene>(scene));
    none.set_measures({.energies = false, .errors = false, .stages = false});
    for (int frame = 0; frame < 5; ++frame) {
      const FrameReport with = all.step();
      const FrameReport without = none.step();
      EXPECT_EQ(with.n_substeps, without.n_substeps);
      EXPECT_EQ(with.work.flops, without.work.flops);
      EXPECT_EQ(with.leader.r, without.leader.r);
      EXPECT_TRUE(std::isfinite(with.energy) && std::isfinite(with.work.residual));
      for (const double unknown :
           {without.kinetic, without.potential, without.energy, without.constraint_error,
            without.joint_gap, without.penetration, without.work.residual, without.times.solve}) {
        EXPECT_TRUE(std::isnan(unknown));
      }
      EXPECT_TRUE(std::isfinite(without.times.total));
    }
    EXPECT_EQ(state_hash(all.state()), state_hash(none.state()));
    EXPECT_EQ(all.observe().energy, none.observe().energy) << "computed on request";
  }
}

TEST(Report, NamesTheBodyThatSetsR) {
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

TEST(Report, TheCapIsReportedWhenItIsInForce) {
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

TEST(Report, TheFirstNDoesNotDependOnTheIntegrator) {
  Settings leapfrog;
  leapfrog.integrator = Integrator::kLeapfrog;
  for (const Scene& scene :
       {scenes::swinging_box(), scenes::bridge(), scenes::heavy_stack_stress()}) {
    EXPECT_EQ(first_frame(scene).n_substeps, first_frame(scene, leapfrog).n_substeps) << scene.name;
  }
}

TEST(Report, WithoutStiffnessNoBodySetsR) {
  Simulator simulator(std::make_shared<const Scene>(scenes::swinging_box()));
  EXPECT_GE(simulator.step().leader.body, 0);
  Settings settings;
  settings.mode = Mode::kConst;
  simulator.set_settings(settings);
  const FrameReport report = simulator.step();
  EXPECT_EQ(report.leader.body, -1);
  EXPECT_TRUE(std::isinf(report.dt_stable));
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

// A rigid joint given twice is a singular but redundant system: equivalent to one joint.
TEST(Failure, ADuplicateRigidJointIsNone) {
  Scene scene = scenes::swinging_box({scenes::kSixtyDegrees, 0.0});
  scene.joints.push_back(scene.joints[3]);
  const Outcome r = run(scene, scene.settings, 2.0);
  EXPECT_TRUE(r.holds) << r.verdict;
  EXPECT_LT(r.joint_gap, 1e-3);
}

// A speed whose square overflows.
TEST(Failure, StopsAtTheLastFiniteStateAndNamesTheBody) {
  const Scene scene = scenes::swinging_box({scenes::kSixtyDegrees, 0.0});
  Simulator simulator(std::make_shared<const Scene>(scene));
  State thrown = simulator.state();
  thrown.u.back().head<3>() = Vec3{1e200, 0.0, 0.0};
  simulator.set_state(thrown);
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

// An explicit gyroscopic torque at this speed gains energy without bound. Velocities stay finite
// for some time after their squares overflow.
TEST(Failure, StopsWhileTheEnergyIsFinite) {
  Scene scene = scenes::spinning_top();
  for (Body& body : scene.bodies) body.angular_velocity = {300.0, 2000.0, 100.0};
  scene.settings.gyroscopic = Gyroscopic::kExplicit;
  scene.settings.mode = Mode::kNone;
  Simulator simulator(std::make_shared<const Scene>(scene));
  FrameReport report;
  for (int i = 0; i < 120; ++i) {
    report = simulator.step();
    EXPECT_TRUE(std::isfinite(report.kinetic)) << "frame " << i;
    if (report.status != StepStatus::kOk) break;
  }
  EXPECT_EQ(report.status, StepStatus::kNotFinite);
}

/// The scene with a frame as short as a sub-step: then every solve is the last of a frame, whose
/// residual is reported.
Scene with_short_frames(Scene scene) {
  scene.frame /= 16.0;
  scene.settings.mode = Mode::kNone;
  return scene;
}

TEST(Solves, AreAllComplementary) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::heavy_stack_stress()}) {
    const Scene shorter = with_short_frames(scene);
    const Outcome r = run(shorter, shorter.settings, 4.0);
    EXPECT_LT(r.residual, 1e-9) << scene.name;
    EXPECT_EQ(r.unsolved, 0) << scene.name;
  }
  // Friction bounds are updated at most four times per sub-step and continue to settle in the next
  // one.
  const Scene bridge = with_short_frames(scenes::bridge());
  int solves = 0;
  std::vector<double> unsettled;  // their residuals
  run(bridge, bridge.settings, 3.0, [&](const Simulator&, const FrameReport& report) {
    ++solves;
    EXPECT_EQ(report.work.unsolved, 0);
    if (report.work.unsettled > 0) {
      unsettled.push_back(report.work.residual);
    } else {
      EXPECT_LT(report.work.residual, 1e-7);
    }
  });
  EXPECT_LT(unsettled.size(), static_cast<std::size_t>(solves / 3));
  EXPECT_LT(Outcome::median(unsettled), 1e-4);
}

// A wall of bricks has far more contact points than it needs: pivoting one row at a time could take
// very long.
TEST(Solves, TakeBoundedWorkOnAWallThatIsHit) {
  Scene scene;
  scene.effects = {.gravity = true, .contact = true, .friction = true};
  const auto add = [&](const Shape& shape, double mass, const Vec3& position) {
    Body body;
    body.name = "body" + std::to_string(scene.bodies.size());
    body.shape = shape;
    body.mass = mass;
    body.inertia = solid_inertia(shape, mass);
    body.position = position;
    body.friction = 0.5;
    scene.bodies.push_back(body);
  };
  add(Plane{}, 0.0, Vec3::Zero());
  scene.bodies[0].is_static = true;
  for (int layer = 0; layer < 6; ++layer) {
    for (int i = 0; i < 4; ++i) {
      add(Box{Vec3{0.2, 0.1, 0.1}}, 1.0, Vec3(0.4 * i + 0.2 * (layer % 2), 0.1 + 0.2 * layer, 0.0));
    }
  }
  add(Sphere{0.3}, 50.0, Vec3(0.7, 0.7, 1.0));
  scene.bodies.back().velocity.z() = -10.0;
  Settings settings;
  settings.mode = Mode::kNone;
  constexpr std::int64_t kMost =
      4 * (20 + 1) + 50 + 1;  // four passes of block pivots, and the single ones
  run(scene, settings, 0.5, [&](const Simulator&, const FrameReport& report) {
    ASSERT_EQ(report.status, StepStatus::kOk);
    EXPECT_LE(report.work.factorisations, kMost);
  });
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
    constexpr std::array kModes{Mode::kAdaptive, Mode::kConst, Mode::kAdaptive, Mode::kCapped};
    settings.mode = kModes[static_cast<std::size_t>(turn % 4)];
    simulator.set_settings(settings);
    const FrameReport report = simulator.step();
    ASSERT_EQ(report.status, StepStatus::kOk);
    ASSERT_LT(report.joint_gap, 0.1) << i;
  }
}

}  // namespace
}  // namespace substep::test
