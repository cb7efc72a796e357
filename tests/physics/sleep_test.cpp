// Bodies at rest do not move and cost nothing until something comes near.

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/collision/contact_point.hpp"
#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

Settings sleeping(Settings settings = {}) {
  settings.sleep = true;
  return settings;
}

TEST(Sleep, AStackAtRestCostsNothing) {
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kNewton}) {
    for (const Mode mode : {Mode::kConst, Mode::kAdaptive}) {
      Simulator simulator =
          simulator_of(scenes::heavy_stack(), sleeping({.solver = solver, .mode = mode, .n = 4}));
      FrameReport report;
      for (int frame = 0; frame < 30; ++frame) {
        report = simulator.step();
        EXPECT_EQ(report.asleep, 0) << "not before half a second";
        EXPECT_GT(report.work.flops, 0);
      }
      const State asleep = simulator.state();
      for (int frame = 30; frame < 90; ++frame) {
        report = simulator.step();
        EXPECT_EQ(report.n_substeps, 0);
        EXPECT_EQ(report.n_mean, 0.0);
        EXPECT_EQ(report.work.flops + report.work.solves + report.criterion.flops, 0);
        EXPECT_EQ(report.contact_rows, 0);
        EXPECT_EQ(report.asleep, 26) << "the whole stack";
        EXPECT_EQ(report.kinetic, 0.0);
        EXPECT_EQ(report.frame, frame + 1);
      }
      for (std::size_t i = 0; i < asleep.x.size(); ++i) {
        EXPECT_EQ(simulator.state().x[i], asleep.x[i]);
      }
    }
  }
}

TEST(Sleep, IsOffByDefault) {
  Simulator simulator = simulator_of(scenes::heavy_stack(), {});
  for (int frame = 0; frame < 60; ++frame) EXPECT_EQ(simulator.step().asleep, 0);
  EXPECT_TRUE(simulator.state().rest.empty());
}

TEST(Sleep, MovingBodiesDoNot) {
  Simulator asked = simulator_of(scenes::swinging_box(), sleeping());
  Simulator plain = simulator_of(scenes::swinging_box(), {});
  for (int frame = 0; frame < 240; ++frame) {
    EXPECT_EQ(asked.step().asleep, 0);
    plain.step();
  }
  EXPECT_EQ(state_hash(asked.state()), state_hash(plain.state()));
}

// The ball and its chain move as if the tower were awake; the tower wakes before it is touched.
TEST(Sleep, ATowerWakesBeforeTheBallTouchesIt) {
  const Scene scene = scenes::wrecking_ball();
  const Settings by_island{.islands = true, .integrator = Integrator::kLeapfrog};
  Simulator asked = simulator_of(scene, sleeping(by_island));
  Simulator plain = simulator_of(scene, by_island);
  const auto is_crate = [&](std::size_t i) { return scene.bodies[i].name.starts_with("crate"); };
  const auto crates = std::count_if(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) {
    return body.name.starts_with("crate");
  });
  int slept = 0;
  bool woken = false;
  for (int frame = 0; frame < 120; ++frame) {
    const State before = asked.state();
    const FrameReport report = asked.step();
    const FrameReport other = plain.step();
    if (report.asleep > 0) {
      ++slept;
      EXPECT_FALSE(woken) << "and does not fall asleep again so soon";
      EXPECT_EQ(report.asleep, crates);
      EXPECT_LT(report.work.flops, other.work.flops);
      for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (is_crate(i)) continue;
        ASSERT_EQ(asked.state().x[i], plain.state().x[i]) << frame;
      }
    } else if (slept > 0 && !woken) {
      woken = true;
      for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        EXPECT_TRUE(!is_crate(i) || before.u[i].isZero(0.0)) << "it was at rest until now";
      }
    }
  }
  EXPECT_GT(slept, 20);
  EXPECT_TRUE(woken);
  double fastest = 0.0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (is_crate(i)) keep_largest(fastest, asked.state().u[i].norm());
  }
  EXPECT_GT(fastest, 1.0) << "and is struck";
}

TEST(Sleep, EndsWithAGrabOrNewSettings) {
  Simulator simulator = simulator_of(scenes::heavy_stack(), sleeping());
  for (int frame = 0; frame < 40; ++frame) simulator.step();
  ASSERT_GT(simulator.step().asleep, 0);
  Grab grab;
  grab.body = static_cast<int>(simulator.scene().bodies.size()) - 1;
  grab.target = simulator.state().x.back() + Vec3{0.0, 0.5, 0.0};
  grab.mass = 1000.0;
  simulator.set_grab(grab);
  EXPECT_EQ(simulator.step().asleep, 0);
  simulator.set_grab(std::nullopt);
  for (int frame = 0; frame < 200; ++frame) simulator.step();
  ASSERT_GT(simulator.step().asleep, 0) << "after release it comes to rest again";
  Settings other = simulator.settings();
  other.alpha = 0.05;
  simulator.set_settings(other);
  EXPECT_EQ(simulator.step().asleep, 0);
}

// Islands are independent: one at rest sleeps beside one that swings.
TEST(Sleep, OneIslandSleepsWhileAnotherSwings) {
  const Scene scene = beside({transformed(scenes::swinging_box(), Quat::Identity(), {0, 0, -30.0}),
                              transformed(scenes::heavy_stack(), Quat::Identity(), {0, 0, 30.0})});
  for (const bool islands : {false, true}) {
    Settings settings = sleeping();
    settings.islands = islands;
    Simulator simulator = simulator_of(scene, settings);
    Simulator box = simulator_of(scenes::swinging_box(), {});
    FrameReport report;
    FrameReport alone;
    for (int frame = 0; frame < 60; ++frame) {
      report = simulator.step();
      alone = box.step();
    }
    EXPECT_EQ(report.asleep, 26);
    EXPECT_EQ(report.n_substeps, alone.n_substeps) << "of the box only: the stack sleeps";
    EXPECT_EQ(report.work.flops, alone.work.flops);
  }
}

// A sleeping island keeps its forces, whatever moves beside it, and wakes with them: its first
// solve has the friction bounds and needs no pivots.
TEST(Sleep, WakesWithTheForcesThatHeldIt) {
  const Scene scene = beside({transformed(scenes::swinging_box(), Quat::Identity(), {0, 0, -30.0}),
                              transformed(scenes::heavy_stack(), Quat::Identity(), {0, 0, 30.0})});
  Simulator simulator = simulator_of(scene, {.mode = Mode::kConst, .n = 1, .sleep = true});
  const auto forces = [&] {
    std::vector<std::pair<std::uint64_t, double>> all;
    for (const StoredForce& force : simulator.state().forces) {
      if (is_contact_id(force.id)) all.emplace_back(force.id, force.lambda[0]);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto before = [&] {
    auto last = forces();
    while (simulator.step().asleep == 0) last = forces();
    return last;
  }();
  EXPECT_FALSE(before.empty());
  for (int frame = 0; frame < 10; ++frame) EXPECT_GT(simulator.step().asleep, 0);
  EXPECT_EQ(forces(), before);
  Settings awake = simulator.settings();
  awake.sleep = false;
  simulator.set_settings(awake);
  const FrameReport report = simulator.step();
  EXPECT_EQ(report.asleep, 0);
  EXPECT_EQ(report.work.pivots, 0);
  EXPECT_EQ(report.work.passes, 1);
}

// A sleeping island also keeps its K, in every mode that reads it.
TEST(Sleep, KeepsTheStiffness) {
  const Scene scene = beside({transformed(scenes::swinging_box(), Quat::Identity(), {0, 0, -30.0}),
                              transformed(scenes::heavy_stack(), Quat::Identity(), {0, 0, 30.0})});
  Simulator simulator = simulator_of(scene, sleeping({.mode = Mode::kStiffness}));
  State before = simulator.state();
  while (simulator.step().asleep == 0) before = simulator.state();
  for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(simulator.step().asleep, 26);
  const State& after = simulator.state();
  ASSERT_EQ(after.K_resisting.size(), scene.bodies.size());
  double known = 0.0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (after.rest[i] <= 0.0) continue;
    EXPECT_EQ(after.K_resisting[i], before.K_resisting[i]);
    EXPECT_EQ(after.k[i], before.k[i]);
    known += after.K_resisting[i].norm();
  }
  EXPECT_GT(known, 0.0);
}

// The cost of a fallen pile decreases.
TEST(Sleep, BallsThatHaveStoppedBouncingSleep) {
  Simulator simulator = simulator_of(scenes::bouncing_balls(), sleeping({.mode = Mode::kConst}));
  FrameReport report;
  int most = 0;
  for (int frame = 0; frame < 600; ++frame) {
    report = simulator.step();
    most = std::max(most, report.asleep);
    EXPECT_TRUE(report.asleep == 0 || report.asleep < 5) << "one of them bounces for ever";
  }
  EXPECT_GE(most, 1);
}

}  // namespace
}  // namespace substep::test
