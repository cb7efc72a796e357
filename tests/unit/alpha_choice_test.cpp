// The alpha that is chosen by an error or by a cost.

#include "core/lab/alpha_choice.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "core/io/experiment.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep {
namespace {

const std::atomic<bool> go_on{false};

struct Chain {
  Scene scene = scenes::rope_of_n({.n = 4});
  Reference reference = find_reference(std::make_shared<const Scene>(scene), 1.0);
  Experiment experiment = [this] {
    Experiment e = experiment_of(scene, Settings{.n_max = 10000});
    e.duration = 1.0;
    return e;
  }();

  [[nodiscard]] Result run(double alpha) const {
    Experiment e = experiment;
    e.settings.alpha = alpha;
    ExperimentRun run(scene, e, reference);
    while (run.advance()) {
    }
    return run.result();
  }
};

TEST(AlphaChoice, IsTheLargestWithinAnError) {
  const Chain chain;
  for (const double error : {4e-3, 1e-3, 3e-4}) {
    const auto choice = largest_alpha_within(chain.scene, chain.experiment, chain.reference,
                                             ErrorAxis::kTrajectory, error, go_on);
    ASSERT_TRUE(choice.has_value());
    EXPECT_LE(*error_of(choice->result, ErrorAxis::kTrajectory), error);
    EXPECT_EQ(error_of(chain.run(choice->alpha), ErrorAxis::kTrajectory),
              error_of(choice->result, ErrorAxis::kTrajectory))
        << "it is the run with this alpha";
    EXPECT_GT(*error_of(chain.run(1.2 * choice->alpha), ErrorAxis::kTrajectory), error);
  }
}

TEST(AlphaChoice, IsTheSmallestWithinACost) {
  const Chain chain;
  for (const double substeps : {20.0, 100.0}) {
    const auto choice = smallest_alpha_within(chain.scene, chain.experiment, chain.reference,
                                              CostAxis::kSubsteps, substeps, go_on);
    ASSERT_TRUE(choice.has_value());
    EXPECT_LE(cost_of(choice->result, CostAxis::kSubsteps), substeps);
    EXPECT_GT(cost_of(chain.run(choice->alpha / 1.1), CostAxis::kSubsteps), substeps);
  }
}

TEST(AlphaChoice, IsNothingWhereNothingServesOrItIsCancelled) {
  const Chain chain;
  EXPECT_FALSE(smallest_alpha_within(chain.scene, chain.experiment, chain.reference,
                                     CostAxis::kSubsteps, 0.5, go_on));
  const std::atomic<bool> cancelled{true};
  EXPECT_FALSE(largest_alpha_within(chain.scene, chain.experiment, chain.reference,
                                    ErrorAxis::kTrajectory, 1.0, cancelled));
}

TEST(AlphaChoice, EndsWhereTheRangeDoes) {
  Chain chain;
  chain.experiment.settings.n_max = 8;  // smaller alphas cost no more
  const auto choice = smallest_alpha_within(chain.scene, chain.experiment, chain.reference,
                                            CostAxis::kSubsteps, 8.0, go_on);
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->alpha, kLeastAlpha);
  const auto any = largest_alpha_within(chain.scene, chain.experiment, chain.reference,
                                        ErrorAxis::kTrajectory, 100.0, go_on);
  ASSERT_TRUE(any.has_value());
  EXPECT_EQ(any->alpha, 1.0);
}

}  // namespace
}  // namespace substep
