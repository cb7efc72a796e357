// The alpha selected by an error or by a cost.

#include "core/lab/alpha_search.hpp"

#include <gtest/gtest.h>

#include "core/io/experiment.hpp"
#include "core/lab/sweep.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep {
namespace {

struct Chain {
  std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(scenes::rope_of_n({.n = 4}));
  Reference reference = find_reference(scene, 1.0);
  Experiment experiment = [this] {
    Experiment e = experiment_of(*scene, paper_settings(*scene));
    e.duration = 1.0;
    return e;
  }();

  [[nodiscard]] AlphaSearch within(double error) const {
    return AlphaSearch::largest_within(scene, experiment, reference, ErrorAxis::kTrajectory, error);
  }
  [[nodiscard]] AlphaSearch within_substeps(double count) const {
    return AlphaSearch::smallest_within(scene, experiment, reference, CostAxis::kSubsteps, count);
  }
  [[nodiscard]] Result run(double alpha) const {
    Experiment e = experiment;
    e.settings.alpha = alpha;
    ExperimentRun run(*scene, e, reference);
    while (run.advance()) {
    }
    return run.result();
  }
};

std::optional<AlphaChoice> found(AlphaSearch search) {
  double before = 0.0;
  while (search.advance(1e-3)) {
    EXPECT_GE(search.progress(), before);
    before = search.progress();
    EXPECT_LT(before, 1.0);
  }
  EXPECT_EQ(search.progress(), 1.0);
  EXPECT_FALSE(search.advance(1e-3)) << "it is done";
  return search.choice();
}

TEST(AlphaSearch, IsTheLargestWithinAnError) {
  const Chain chain;
  for (const double error : {4e-3, 1e-3, 3e-4}) {
    const auto choice = found(chain.within(error));
    ASSERT_TRUE(choice.has_value());
    EXPECT_LE(*error_of(choice->result, ErrorAxis::kTrajectory), error);
    EXPECT_EQ(error_of(chain.run(choice->alpha), ErrorAxis::kTrajectory),
              error_of(choice->result, ErrorAxis::kTrajectory))
        << "it is the run with this alpha";
    EXPECT_GT(*error_of(chain.run(1.2 * choice->alpha), ErrorAxis::kTrajectory), error);
  }
}

TEST(AlphaSearch, IsTheSmallestWithinACost) {
  const Chain chain;
  for (const double substeps : {20.0, 100.0}) {
    const auto choice = found(chain.within_substeps(substeps));
    ASSERT_TRUE(choice.has_value());
    EXPECT_LE(cost_of(choice->result, CostAxis::kSubsteps), substeps);
    EXPECT_GT(cost_of(chain.run(choice->alpha / 1.1), CostAxis::kSubsteps), substeps);
  }
}

TEST(AlphaSearch, IsEmptyWhereNoAlphaMeetsTheLimit) {
  const Chain chain;
  EXPECT_FALSE(found(chain.within_substeps(0.5)));
  Chain capped;
  capped.experiment.settings.n_max = 4;
  EXPECT_FALSE(found(capped.within(1e-6))) << "down to the smallest alpha";
}

// With so few sub-steps the chain tears; a failing run is not a valid result, however cheap.
TEST(AlphaSearch, IsEmptyWhereTheRunFails) {
  Chain chain;
  chain.experiment.settings.n_max = 1;
  EXPECT_FALSE(chain.run(1.0).metrics.holds);
  EXPECT_FALSE(found(chain.within_substeps(3.0)));
}

TEST(AlphaSearch, IsTheSmallestWithinAMeasuredTime) {
  const Chain chain;
  const auto choice = found(AlphaSearch::smallest_within(chain.scene, chain.experiment,
                                                         chain.reference, CostAxis::kTime, 1e12));
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->alpha, AlphaSearch::kLeast) << "every alpha is within it";
}

TEST(AlphaSearch, UsesTheSettingsOfTheSweepsCurve) {
  Scene own = scenes::rope_of_n({.n = 4});
  own.settings.drift_order = 2;
  own.settings.refinements = 3;
  own.settings.sleep = true;
  own.settings.contact_stiffness = ContactStiffness::kExact;
  own.settings.memory = 0.5;  // not one of the curves
  Settings paper = paper_settings(own);
  EXPECT_EQ(paper.memory, 0.5);
  bool found_curve = false;
  for (const SweepPoint& point : default_sweep(own)) {
    paper.alpha = point.settings.alpha;
    found_curve = found_curve || point.settings == paper;
  }
  EXPECT_TRUE(found_curve);
}

TEST(AlphaSearch, EndsWhereTheRangeDoes) {
  Chain chain;
  const auto any = found(chain.within(100.0));
  ASSERT_TRUE(any.has_value());
  EXPECT_EQ(any->alpha, 1.0);
  chain.experiment.settings.n_max = 8;  // smaller alphas cost no more
  const auto choice = found(chain.within_substeps(8.0));
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->alpha, AlphaSearch::kLeast);
}

TEST(AlphaSearch, AdvancesByAFrameAndReportsItsTrial) {
  const Chain chain;
  AlphaSearch search = chain.within(1e-3);
  EXPECT_EQ(search.alpha(), 1.0);
  EXPECT_EQ(search.runs(), 1);
  int frames = 0;
  for (; search.runs() == 1; ++frames) ASSERT_TRUE(search.advance(0.0));
  EXPECT_EQ(frames, 60) << "of one second";
  EXPECT_EQ(search.alpha(), 0.25);
  EXPECT_FALSE(search.choice()) << "1 is too large for a millimetre";
}

}  // namespace
}  // namespace substep
