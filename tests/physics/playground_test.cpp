// The playground scenes: jointed and loose bodies, edges and faces, many simultaneous contacts.

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

double lowest(const State& state, std::size_t first) {
  double y = state.x[first].y();
  for (std::size_t i = first; i < state.x.size(); ++i) y = std::min(y, state.x[i].y());
  return y;
}

// Only friction and balance: no card may creep, even in a long run.
TEST(CardHouse, StandsStillWithTheDirectSolver) {
  const Scene scene = scenes::card_house();
  const Outcome r = run(scene, scene.settings, 10.0);
  EXPECT_TRUE(r.holds) << r.verdict;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    EXPECT_LT((r.end.x[i] - scene.bodies[i].position).norm(), 1e-3) << scene.bodies[i].name;
  }
}

TEST(CardHouse, FallsWithTwentyFiveIterationsOfGaussSeidel) {
  const Scene scene = scenes::card_house();
  const Outcome r = run(scene, {.solver = SolverKind::kPgs}, 5.0);
  EXPECT_FALSE(r.holds);
}

TEST(CardHouse, FallsWithoutEnoughFriction) {
  Scene scene = scenes::card_house(2);
  for (Body& body : scene.bodies) body.friction = 0.1;
  const Outcome r = run(scene, scene.settings, 5.0);
  EXPECT_FALSE(r.holds);
}

TEST(Wall, StandsUntilTheBallHitsIt) {
  const Scene scene = scenes::wall();
  const auto ball = scene.bodies.size() - 1;
  const auto top = ball - 3;  // a brick in the middle of the last course
  double moved_before = 0.0;
  double moved = 0.0;
  const Outcome r = run(scene, scene.settings, 3.0, [&](const Simulator& s, const FrameReport&) {
    moved = (s.state().x[top] - scene.bodies[top].position).norm();
    if (s.state().time < 0.4) keep_largest(moved_before, moved);
  });
  EXPECT_TRUE(r.holds) << r.verdict;
  EXPECT_LT(moved_before, 0.005);
  EXPECT_GT(moved, 0.5);
  EXPECT_LT(r.energy_end, r.energy_start);
  EXPECT_GT(lowest(r.end, 1), 0.0) << "a body fell through the floor";
}

TEST(WreckingBall, BringsTheTowerDownAndItsChainHolds) {
  const Scene scene = scenes::wrecking_ball();
  const auto crate = scene.bodies.size() - 1;
  const Outcome r = run(scene, scene.settings, 5.0);
  EXPECT_TRUE(r.holds) << r.verdict;
  EXPECT_LT(r.joint_gap, 0.02);
  EXPECT_LT(r.end.x[crate].y(), 1.5) << "it started at 2.25 m";
  EXPECT_LT(r.energy_end, r.energy_start);
  EXPECT_GT(lowest(r.end, 1), 0.0);
}

TEST(Ragdolls, LandInOnePieceAndComeToRest) {
  const Scene scene = scenes::ragdoll_drop();
  double fastest = 0.0;
  double at_last = 0.0;
  const Outcome r =
      run(scene, scene.settings, 8.0, [&](const Simulator&, const FrameReport& report) {
        keep_largest(fastest, report.kinetic);
        at_last = report.kinetic;
      });
  EXPECT_TRUE(r.holds) << r.verdict;
  EXPECT_LT(r.joint_gap, 0.05);
  EXPECT_LT(at_last, 0.02 * fastest);
  EXPECT_GT(lowest(r.end, 1), 0.0);
}

}  // namespace
}  // namespace substep::test
