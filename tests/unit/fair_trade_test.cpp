// Adaptive sub-stepping compared with the best constant N in hindsight.

#include "core/lab/fair_trade.hpp"

#include <gtest/gtest.h>

#include "core/io/stored_sweep.hpp"
#include "core/lab/sweep.hpp"
#include "scenes/generator/scenes.hpp"
#include "scenes/generator/sweeps.hpp"

namespace substep {
namespace {

const Scene& chain() {
  static const Scene scene = scenes::swinging_box();
  return scene;
}

/// A run with this mean N and gap; a negative gap is a failed run.
Result run(Mode mode, double parameter, double load, double mean_n, double gap) {
  Result result;
  result.experiment.settings = paper_settings(chain());
  result.experiment.settings.mode = mode;
  if (mode == Mode::kConst) {
    result.experiment.settings.n = static_cast<int>(parameter);
  } else {
    result.experiment.settings.alpha = parameter;
  }
  result.experiment.load = load;
  result.metrics.work.frames = 100;
  result.metrics.work.substeps = static_cast<std::int64_t>(100.0 * mean_n);
  result.metrics.holds = gap >= 0.0;
  if (gap >= 0.0) result.metrics.errors.joint_gap = PeakAndMedian{gap, gap};
  return result;
}

Result constant(int n, double load, double gap) { return run(Mode::kConst, n, load, n, gap); }

TEST(FairTrade, TakesTheSmallestConstantThatIsAsAccurate) {
  const std::vector<Result> results{constant(4, 1.0, -1.0), constant(6, 1.0, 3e-3),
                                    constant(8, 1.0, 1.04e-3), constant(12, 1.0, 5e-4),
                                    run(Mode::kAdaptive, 0.1, 1.0, 5.5, 1e-3)};
  const FairTrade trade = fair_trade(chain(), results, Policy::kFrame, 0.1);
  ASSERT_EQ(trade.rows.size(), 1U);
  EXPECT_EQ(trade.axis, ErrorAxis::kGap);
  EXPECT_DOUBLE_EQ(trade.rows[0].n(), 5.5);
  ASSERT_NE(trade.rows[0].constant, nullptr);
  EXPECT_EQ(trade.rows[0].constant->experiment.settings.n, 8);
  EXPECT_EQ(trade.rows[0].too_few, 6);
  EXPECT_EQ(trade.for_all, 8);
}

TEST(FairTrade, OneConstantServesAllLoadsOnlyIfItIsEnoughForEach) {
  std::vector<Result> results{constant(2, 0.1, 1e-4),
                              constant(8, 0.1, 1e-5),
                              constant(2, 10.0, -1.0),
                              constant(8, 10.0, 2e-3),
                              run(Mode::kAdaptive, 0.1, 0.1, 2.5, 1e-4),
                              run(Mode::kAdaptive, 0.1, 10.0, 20.0, 1e-3)};
  FairTrade trade = fair_trade(chain(), results, Policy::kFrame, 0.1);
  ASSERT_EQ(trade.rows.size(), 2U);
  EXPECT_EQ(trade.rows[0].constant->experiment.settings.n, 2) << "hindsight for this load";
  EXPECT_EQ(trade.rows[0].too_few, 0);
  EXPECT_EQ(trade.rows[1].constant, nullptr);
  EXPECT_EQ(trade.rows[1].too_few, 8);
  EXPECT_FALSE(trade.for_all);
  EXPECT_EQ(trade.most_n, 8);
  EXPECT_DOUBLE_EQ(trade.mean_n(), 11.25);

  results.push_back(constant(30, 0.1, 1e-6));
  results.push_back(constant(30, 10.0, 1e-3));
  trade = fair_trade(chain(), results, Policy::kFrame, 0.1);
  EXPECT_EQ(trade.for_all, 30);
}

TEST(FairTrade, AFailedAdaptiveRunIsNotCompared) {
  const std::vector<Result> results{constant(4, 1.0, 1e-3),
                                    run(Mode::kAdaptive, 1.0, 1.0, 3.0, -1.0)};
  const FairTrade trade = fair_trade(chain(), results, Policy::kFrame, 1.0);
  ASSERT_EQ(trade.rows.size(), 1U);
  EXPECT_FALSE(trade.holds());
  EXPECT_EQ(trade.rows[0].constant, nullptr);
  EXPECT_FALSE(trade.for_all);
}

TEST(FairTrade, NothingToCompareIsEmpty) {
  EXPECT_TRUE(fair_trade(chain(), {}, Policy::kFrame, 0.1).rows.empty());
  EXPECT_FALSE(fair_trade(chain(), {}, Policy::kFrame, 0.1).for_all);
  EXPECT_TRUE(fair_trade(chain(), {}, Policy::kFrame, 0.1).alphas.empty());
}

/// The claim of the scene that was made for it, from the sweep that is shipped with it.
TEST(FairTrade, NoConstantNIsAsCheapForTheConvoy) {
  const Scene scene = scenes::convoy();
  const auto stored = read_sweep(scenes::sweep_of("convoy"), scene);
  ASSERT_TRUE(stored);
  const FairTrade trade = fair_trade(scene, stored->results, Policy::kSubstep, 0.25);
  ASSERT_EQ(trade.rows.size(), 1U);
  ASSERT_TRUE(trade.holds());
  EXPECT_GT(trade.rows[0].too_few, 1.3 * trade.rows[0].n())
      << "even the largest insufficient N takes a third more sub-steps";
}

TEST(FairTrade, OneConstantForAllLoadsOfTheSwingingBoxCostsTwice) {
  const auto stored = read_sweep(scenes::sweep_of("swinging_box"), chain());
  ASSERT_TRUE(stored);
  const FairTrade trade = fair_trade(chain(), stored->results, Policy::kFrame, 0.45);
  EXPECT_EQ(trade.alphas, (std::vector<double>{0.05, 0.1, 0.25, 0.5, 1.0}));
  EXPECT_EQ(trade.alpha, 0.5) << "the alpha nearest to 0.45";
  ASSERT_EQ(trade.rows.size(), 6U);
  ASSERT_TRUE(trade.holds());
  for (std::size_t i = 1; i < trade.rows.size(); ++i) {
    EXPECT_LT(trade.rows[i - 1].load, trade.rows[i].load);
    EXPECT_LT(trade.rows[i - 1].n(), trade.rows[i].n()) << "a heavier box takes more";
  }
  EXPECT_GT(trade.for_all.value_or(trade.most_n), 2.0 * trade.mean_n());
}

}  // namespace
}  // namespace substep
