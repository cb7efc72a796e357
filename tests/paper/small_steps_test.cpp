// Small steps (Macklin et al. 2019, "Small steps in physics simulation"): contacts are predicted
// once per frame, and the sweeps of a frame are distributed over its sub-steps.

#include <gtest/gtest.h>

#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

/// 64 sweeps per frame.
Settings small_steps(SolverKind solver, int n) {
  Settings settings;
  settings.solver = solver;
  settings.mode = Mode::kConst;
  settings.n = n;
  settings.iterations = 64;
  settings.share_iterations = true;
  settings.detection = Detection::kFrame;
  return settings;
}

/// Ten links of 1 kg with 1000 kg at the end, released at 60 degrees.
Outcome swing_rope(const Settings& settings) {
  return run(scenes::rope_of_n({.n = 10}), settings, 2.0, {}, false);
}

TEST(SmallSteps, DistributeTheSameSweeps) {
  const auto scene = std::make_shared<const Scene>(scenes::rope_of_n({.n = 10}));
  for (const SolverKind kind : {SolverKind::kPgs, SolverKind::kXpbd}) {
    std::int64_t of_one = 0;
    for (const int n : {1, 4, 16, 64}) {
      Simulator simulator = simulator_of(scene, small_steps(kind, n));
      const FrameReport report = simulator.step();
      EXPECT_EQ(report.n_substeps, n);
      EXPECT_EQ(report.work.iterations, 64);
      if (n == 1) of_one = report.work.row_updates;
      EXPECT_EQ(report.work.row_updates, of_one);
    }
    Simulator simulator = simulator_of(scene, small_steps(kind, 200));
    EXPECT_EQ(simulator.step().work.iterations, 200) << "at least one in each";
  }
}

// The claim: when sweeps move bodies, joints stretch less the more sub-steps share the sweeps.
TEST(SmallSteps, StretchLessWithTheSameSweeps) {
  double before = 1.0;
  for (const int n : {1, 2, 4, 8, 16, 32}) {
    const double gap = swing_rope(small_steps(SolverKind::kXpbd, n)).joint_gap;
    EXPECT_LT(gap, 0.75 * before) << n;
    before = gap;
  }
  EXPECT_LT(before, 0.02);
}

// When sweeps compute forces from zero, as Gauss-Seidel does here, a few sweeps no longer reach the
// end of the chain: the optimum is in between.
TEST(SmallSteps, WithForcesHaveAnOptimumInBetween) {
  const double gap_8 = swing_rope(small_steps(SolverKind::kPgs, 8)).joint_gap;
  EXPECT_GT(swing_rope(small_steps(SolverKind::kPgs, 4)).joint_gap, 10.0 * gap_8);
  EXPECT_GT(swing_rope(small_steps(SolverKind::kPgs, 32)).joint_gap, 2.0 * gap_8);
  EXPECT_LT(gap_8, 0.05);
}

/// A ball of 2 cm thrown at a plate of 4 mm. @return its greatest depth below the plate's middle
/// [m]
double below_the_plate(Detection detection, double speed) {
  Scene scene;
  scene.effects.contact = true;
  scene.contact.margin = 1e-3;
  Body plate;
  plate.is_static = true;
  plate.shape = Box{Vec3{1.0, 0.002, 1.0}};
  Body ball;
  ball.mass = 1.0;
  ball.shape = Sphere{0.02};
  ball.inertia = solid_inertia(ball.shape, ball.mass);
  ball.position = {0.0, 0.3, 0.0};
  ball.velocity = {0.1 * speed, -speed, 0.0};
  scene.bodies = {plate, ball};
  Settings settings;
  settings.mode = Mode::kNone;
  settings.detection = detection;
  double lowest = 1.0;
  run(
      scene, settings, 0.5,
      [&](const Simulator& simulator, const FrameReport&) {
        lowest = std::min(lowest, simulator.state().x[1].y());
      },
      false);
  return -lowest;
}

TEST(SmallSteps, StopFastBodies) {
  EXPECT_GT(below_the_plate(Detection::kSubstep, 40.0), 1.0)
      << "detection per sub-step misses the contact";
  for (const double speed : {2.0, 10.0, 40.0, 200.0}) {
    const double pushed = 1e-10 * 60.0 * speed;  // by the compliance, while a frame stops it
    EXPECT_NEAR(below_the_plate(Detection::kFrame, speed), -0.022, 1.1 * pushed + 1e-12) << speed;
  }
}

double deepest_overlap(const Scene& scene, const Settings& settings, double seconds) {
  double deepest = 0.0;
  run(
      scene, settings, seconds,
      [&](const Simulator&, const FrameReport& report) {
        keep_largest(deepest, report.penetration);
      },
      false);
  return deepest;
}

// A ball at rest is struck, and hits a third one that it could not have reached by itself.
TEST(SmallSteps, DetectContactsOfAStruckBodyWithinTheFrame) {
  Scene scene;
  scene.effects.contact = true;
  const auto ball = [&](double x, double mass, double speed) {
    Body body;
    body.shape = Sphere{0.02};
    body.mass = mass;
    body.inertia = solid_inertia(body.shape, mass);
    body.position.x() = x;
    body.velocity.x() = speed;
    scene.bodies.push_back(body);
  };
  ball(-0.1, 10.0, 30.0);
  ball(0.0, 0.1, 0.0);
  ball(0.2, 1e6, 0.0);
  Settings settings;
  settings.mode = Mode::kConst;
  settings.n = 32;
  settings.detection = Detection::kFrame;
  const Outcome r = run(scene, settings, 0.02, {}, false);
  EXPECT_GT(r.end.x[2].x() - r.end.x[1].x(), 0.0399) << "it does not pass through the third ball";
}

// The row of one edge does not predict the next edge. When only that row was moved along, boxes
// rotated about it into each other, and the chain's light links were ejected at 60 rad/s.
TEST(SmallSteps, DetectBoxesAgainAsTheyRotate) {
  Settings settings;
  EXPECT_GT(deepest_overlap(scenes::ragdoll_drop(), settings, 3.0), 0.02) << "found too late";
  settings.detection = Detection::kFrame;
  EXPECT_LT(deepest_overlap(scenes::ragdoll_drop(), settings, 3.0), 2e-3);
  EXPECT_LT(deepest_overlap(scenes::card_house(), settings, 1.0), 2e-3);
  const Scene ball = scenes::wrecking_ball();
  double fastest = 0.0;
  run(ball, settings, 2.0, [&](const Simulator& simulator, const FrameReport&) {
    for (std::size_t i = 0; i < ball.bodies.size(); ++i) {
      if (!ball.bodies[i].name.starts_with("link")) continue;
      keep_largest(fastest, simulator.state().u[i].tail<3>().norm());
    }
  });
  EXPECT_LT(fastest, 20.0);
}

// The bridge from all starts, a stack and two playground scenes, with contacts that were detected
// up to a frame ago.
TEST(SmallSteps, CarriedContactsHoldTheSameScenes) {
  Settings settings;
  settings.detection = Detection::kFrame;
  for (const scenes::BridgeOptions& options : scenes::bridge_starts()) {
    const Outcome r = run(scenes::bridge(options), settings, 6.0);
    EXPECT_TRUE(r.holds) << r.verdict;
    EXPECT_LT(r.joint_gap, 0.02);
  }
  for (const Scene& scene :
       {scenes::heavy_stack(), scenes::wrecking_ball(), scenes::ragdoll_drop()}) {
    Settings own = scene.settings;
    own.detection = Detection::kFrame;
    const Outcome r = run(scene, own, 4.0);
    EXPECT_TRUE(r.holds) << scene.name << ": " << r.verdict;
  }
}

}  // namespace
}  // namespace substep::test
