// A frame stops before it exceeds its budget of memory or work, reports the cause, and leaves the
// last good state.

#include "core/model/budget.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

#include "core/lab/stop_text.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

/// Falling spheres, all at one point or in a row.
Scene spheres(int count, double spacing) {
  SceneBuilder builder("spheres");
  for (int i = 0; i < count; ++i) builder.add_body(Sphere{0.1}, 1.0, {spacing * i, 0, 0});
  return *builder.build();
}

FrameReport first_frame(const Scene& scene, const Settings& settings, const Budget& budget = {}) {
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.set_settings(settings);
  simulator.set_budget(budget);
  EXPECT_TRUE(simulator.problems().empty());
  const std::uint64_t before = state_hash(simulator.state());
  const FrameReport report = simulator.step();
  if (report.status != StepStatus::kOk) {
    EXPECT_EQ(state_hash(simulator.state()), before);
    EXPECT_EQ(simulator.step().status, report.status);  // the status persists
    EXPECT_EQ(simulator.observe().overrun.bodies, report.overrun.bodies);
  }
  return report;
}

class AtOnePoint : public testing::TestWithParam<int> {};

TEST_P(AtOnePoint, SpheresAreRefusedByTheSizeOfTheirFactor) {
  const int n = GetParam();
  const FrameReport report = first_frame(spheres(n, 0.0), PaperSettings{});
  ASSERT_EQ(report.status, StepStatus::kOverBudget);
  EXPECT_EQ(report.overrun.contacts, n * (n - 1) / 2);
  EXPECT_EQ(report.overrun.bodies, n);
  EXPECT_EQ(report.overrun.budget, Budget{}.memory);
  // All bodies are coupled: the fill of each on the k later ones has 36 k^2 numbers.
  double expected = 0.0;
  for (double k = 0; k < n; ++k) expected += 8.0 * 36.0 * k * k;
  EXPECT_GT(report.overrun.memory, 0.99 * expected);
  EXPECT_LT(report.overrun.memory, 1.1 * expected);
}
INSTANTIATE_TEST_SUITE_P(Counts, AtOnePoint, testing::Values(200, 300, 600));

TEST(Budget, ReportsWhatNeedsHowMuch) {
  const FrameReport report = first_frame(spheres(300, 0.0), PaperSettings{});
  EXPECT_EQ(overrun_text(report.overrun),
            "44850 contacts of 300 bodies would need 2.4 GiB for the direct solver; the budget is "
            "512 MiB");
}

TEST(Budget, AMarginThatReachesAllBodiesIsRefusedLikeOverlaps) {
  Scene scene = spheres(300, 0.01);
  scene.contact.margin = 10.0;
  const FrameReport report = first_frame(scene, PaperSettings{});
  ASSERT_EQ(report.status, StepStatus::kOverBudget);
  EXPECT_EQ(report.overrun.contacts, 44850);
  EXPECT_GT(report.overrun.memory, Budget{}.memory);
}

TEST(Budget, AFrameMustFitIntoIt) {
  const Scene scene = spheres(40, 0.0);
  const PaperSettings settings;
  EXPECT_EQ(first_frame(scene, settings).status, StepStatus::kOk);
  EXPECT_EQ(first_frame(scene, settings, {4.0 * kMebibyte, 2e10}).status, StepStatus::kOverBudget);
  EXPECT_EQ(first_frame(scene, settings, {16.0 * kMebibyte, 2e10}).status, StepStatus::kOk);
}

/// A ball on a floor whose frame has a small budget and many sweeps.
Settings long_sweeps(SolverKind solver) {
  PaperSettings settings;
  settings.solver = solver;
  settings.iterations = 100000;
  settings.mode = Mode::kConst;
  settings.n = 10000;
  return settings;
}

// The work of moving bodies alone uses up the budget: the reported requirement exceeds it.
TEST(Budget, TheRequirementIncludesTheWorkOfBodies) {
  SceneBuilder builder("chain");
  for (int i = 0; i < 10000; ++i) {
    builder.add_body(Sphere{0.1}, 1.0, {0.3 * i, 0, 0});
    builder.add_ball_joint(i, i - 1, {0.3 * i - 0.15, 0, 0});
  }
  PaperSettings settings;
  settings.mode = Mode::kConst;
  settings.n = 10000;
  const FrameReport report = first_frame(*builder.build(), settings);
  ASSERT_EQ(report.status, StepStatus::kOverBudget);
  EXPECT_GT(report.overrun.work, report.overrun.budget);
  EXPECT_FALSE(report.overrun.of_substep);
}

TEST(Budget, TheProductOfSubstepsIterationsAndRowsIsBounded) {
  SceneBuilder builder("pendulum");
  builder.add_body(Sphere{0.1}, 1.0, {1, 0, 0});
  builder.add_ball_joint(0, kWorld, {0, 0, 0});
  for (const SolverKind solver : {SolverKind::kPgs, SolverKind::kXpbd}) {
    const FrameReport report = first_frame(*builder.build(), long_sweeps(solver));
    ASSERT_EQ(report.status, StepStatus::kOverBudget);
    EXPECT_EQ(report.n_substeps, 1);  // not taken
    EXPECT_EQ(report.overrun.substeps, 10000);
    EXPECT_EQ(report.overrun.iterations, 100000);
    EXPECT_EQ(report.overrun.rows, 3);
    EXPECT_GT(report.overrun.work, 1e9 * 3);  // a billion updates of three rows
    const std::string text = overrun_text(report.overrun);
    EXPECT_TRUE(
        text.starts_with("10000 sub-steps of 100000 iterations on 3 rows of 1 body would "
                         "need "))
        << text;
  }
}

TEST(Budget, TheForecastOfSweepsIsTheirWork) {
  SceneBuilder builder("pendulum");
  builder.add_body(Sphere{0.1}, 1.0, {1, 0, 0});
  builder.add_ball_joint(0, kWorld, {0, 0, 0});
  Settings settings = long_sweeps(SolverKind::kPgs);
  settings.iterations = 50;
  settings.n = 20;
  const FrameReport taken = first_frame(*builder.build(), settings, {kMebibyte, 1e9});
  ASSERT_EQ(taken.status, StepStatus::kOk);
  settings.iterations = 5000;
  settings.n = 2000;
  const FrameReport refused = first_frame(*builder.build(), settings, {kMebibyte, 1e6});
  ASSERT_EQ(refused.status, StepStatus::kOverBudget);
  const double per_visit = static_cast<double>(taken.work.flops) / (50.0 * 20.0);
  EXPECT_NEAR(refused.overrun.work / (5000.0 * 2000.0) / per_visit, 1.0, 0.1);
}

TEST(Budget, ManyFreeBodiesInManySubstepsAreRefusedToo) {
  Scene scene = spheres(3000, 1.0);
  scene.effects.contact = false;
  PaperSettings settings;
  settings.mode = Mode::kConst;
  settings.n = 10000;
  const FrameReport report = first_frame(scene, settings, {kMebibyte, 1e9});
  EXPECT_EQ(report.status, StepStatus::kOverBudget);
  EXPECT_EQ(report.overrun.bodies, 3000);
  EXPECT_EQ(report.overrun.rows, 0);
}

TEST(Budget, ADirectSolveStopsWhenItsPivotsHaveUsedItUp) {
  PaperSettings settings;
  settings.mode = Mode::kConst;
  settings.n = 100;
  const FrameReport report = first_frame(spheres(40, 0.0), settings, {64.0 * kMebibyte, 1e6});
  ASSERT_EQ(report.status, StepStatus::kOverBudget);
  EXPECT_GT(report.overrun.work, 1e6);
  EXPECT_EQ(report.overrun.memory, 0.0);
}

TEST(Budget, IsKeptByNewtonToo) {
  PaperSettings settings;
  settings.solver = SolverKind::kNewton;
  const FrameReport report = first_frame(spheres(200, 0.0), settings);
  EXPECT_EQ(report.status, StepStatus::kOverBudget);
  EXPECT_GT(report.overrun.memory, Budget{}.memory);
}

TEST(Budget, AFrameContinuesFromTheLastStateWithAnotherSolver) {
  Simulator simulator(std::make_shared<const Scene>(spheres(200, 0.0)));
  ASSERT_EQ(simulator.step().status, StepStatus::kOverBudget);
  PaperSettings settings;
  settings.solver = SolverKind::kPgs;
  settings.mode = Mode::kNone;
  settings.iterations = 1;
  simulator.set_settings(settings);
  simulator.set_state(State(simulator.state()));
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

TEST(Budget, OutOfRangeIsRefused) {
  Simulator simulator(std::make_shared<const Scene>(spheres(1, 0.0)));
  for (const double memory : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    simulator.set_budget({memory, 1e9});
    EXPECT_EQ(simulator.step().status, StepStatus::kInvalid);
    EXPECT_EQ(simulator.problems().front().pointer, "/budget/memory");
    EXPECT_EQ(simulator.budget(), Budget{});
  }
  simulator.set_budget({kMebibyte, 1e9});
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

}  // namespace
}  // namespace substep
