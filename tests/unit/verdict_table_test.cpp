// The runs selected by the rules of a verdict table, and the results that count as expected.

#include "core/lab/verdict_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/io/experiment.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep {
namespace {

/// The verdict that the table expects for a run, by the run's name.
std::optional<Expected> expected(const Scene& scene, const std::string& name) {
  for (const VerdictCell& cell : verdict_table(scene)) {
    if (cell_name(cell.settings) == name) return cell.expected.verdict;
  }
  return std::nullopt;
}

TEST(VerdictTable, ASceneWithoutRulesIsCheckedWithItsOwnSettings) {
  Scene scene = scenes::pendulum();
  scene.criteria.holds = false;
  const auto table = verdict_table(scene);
  ASSERT_EQ(table.size(), 1U);
  EXPECT_TRUE(table[0].settings == scene.settings);
  EXPECT_EQ(table[0].expected.verdict, Expected::kFails);
}

TEST(VerdictTable, ALaterRuleOverridesAnEarlierOne) {
  Scene scene = scenes::pendulum();
  scene.verdicts = {{.verdict = Expected::kHolds},
                    {.solver = SolverKind::kPgs, .verdict = Expected::kFails},
                    {.solver = SolverKind::kPgs,
                     .mode = Mode::kConst,
                     .n = 7,
                     .integrator = Integrator::kLeapfrog,
                     .verdict = Expected::kDepends,
                     .why = "Chance."}};
  // Const 7 is for PGS only. Newton and XPBD: one sub-step, const 4 and 16.
  EXPECT_EQ(verdict_table(scene).size(), 2U * (9U + 10U) + 2U * 3U);
  EXPECT_EQ(expected(scene, "bpp none euler"), Expected::kHolds);
  EXPECT_EQ(expected(scene, "pgs const 7 euler"), Expected::kFails);
  EXPECT_EQ(expected(scene, "pgs const 7 leapfrog"), Expected::kDepends);
  EXPECT_EQ(expected(scene, "bpp const 7 leapfrog"), std::nullopt);
  EXPECT_EQ(expected(scene, "bpp const 16 leapfrog"), Expected::kHolds);
  EXPECT_EQ(expected(scene, "newton const 16 euler"), Expected::kHolds);
  EXPECT_EQ(expected(scene, "newton adaptive euler"), std::nullopt);
  EXPECT_EQ(expected(scene, "xpbd none leapfrog"), std::nullopt);
  EXPECT_EQ(expected(scene, "pgs const 4 leapfrog"), Expected::kFails);
}

TEST(VerdictTable, OmitsRunsThatNoRuleSelects) {
  Scene scene = scenes::pendulum();
  scene.verdicts = {{.solver = SolverKind::kBpp, .mode = Mode::kAdaptive}};
  EXPECT_EQ(verdict_table(scene).size(), 2U);
  EXPECT_EQ(expected(scene, "pgs adaptive euler"), std::nullopt);
}

/// Judges a run of the pendulum with `limit` as the bound on its displacement [m].
Judgement judged(const Expectation& expectation, double limit) {
  Scene scene = scenes::pendulum();
  scene.criteria.duration = 1.0;
  scene.criteria.displacement = Criteria::Displacement{0, limit};
  ExperimentRun run(scene, experiment_of(scene, scene.settings), no_reference());
  while (run.advance()) {
  }
  return judge(scene, expectation, run);
}

TEST(VerdictTable, AFailureIsExpectedOnlyBeforeItsTime) {
  const Expectation holds;
  const Expectation fails{.verdict = Expected::kFails};
  Expectation at_once = fails;
  at_once.before = 0.1;
  // The rod's centre swings by 0.6 m.
  EXPECT_TRUE(judged(holds, 10.0).as_expected);
  EXPECT_GT(judged(holds, 10.0).margin, 0.9);
  EXPECT_FALSE(judged(fails, 10.0).as_expected);
  EXPECT_FALSE(judged(holds, 0.3).as_expected);
  EXPECT_TRUE(judged(fails, 0.3).as_expected);
  EXPECT_FALSE(judged(at_once, 0.3).as_expected);
  EXPECT_EQ(judged(at_once, 0.3).margin, 0.0);
  EXPECT_TRUE(judged({.verdict = Expected::kDepends, .why = "Chance."}, 0.3).as_expected);
}

TEST(VerdictTable, EveryShippedSceneHasOneAndFewVerdictsDepend) {
  std::size_t cells = 0;
  std::size_t depends = 0;
  for (const Scene& scene : scenes::shipped()) {
    const auto table = verdict_table(scene);
    EXPECT_GE(table.size(), 36U) << scene.name;
    std::set<std::string> names;
    for (const VerdictCell& cell : table) {
      ++cells;
      EXPECT_TRUE(names.insert(cell_name(cell.settings)).second);
      if (cell.expected.verdict != Expected::kDepends) continue;
      ++depends;
      EXPECT_FALSE(cell.expected.why.empty()) << scene.name;
    }
    // The scene's own start settings are one of the cells, unless they are its recommendation or
    // have islands.
    if (scene.settings != own_settings(scene) || scene.settings.islands) {
      EXPECT_TRUE(scene.criteria.holds) << scene.name;
      continue;
    }
    const auto own = expected(scene, cell_name(own_settings(scene)));
    ASSERT_TRUE(own.has_value()) << scene.name;
    EXPECT_EQ(*own == Expected::kHolds, scene.criteria.holds) << scene.name;
  }
  EXPECT_LE(20 * depends, cells) << depends << " of " << cells;
}

TEST(VerdictTable, IsNotInTheHashOfTheScene) {
  Scene scene = scenes::pendulum();
  const std::uint64_t before = scene_hash(scene);
  scene.verdicts = {Expectation{}};
  EXPECT_EQ(scene_hash(scene), before);
}

}  // namespace
}  // namespace substep
