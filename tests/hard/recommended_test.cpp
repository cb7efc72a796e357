// The recommendations of the shipped scenes keep their stated error and cost.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/io/experiment.hpp"
#include "core/lab/recommendation.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep {
namespace {

Reference certain_reference(const Scene& scene, const Recommended& kept) {
  ReferenceRun run(std::make_shared<const Scene>(scene), kept.seconds, {},
                   kept.within / kTimesAsCertain);
  while (run.advance()) {
  }
  return run.reference();
}

Result run_for(const Scene& scene, double seconds, const Reference& reference) {
  Experiment experiment = experiment_of(scene, scene.recommended->settings);
  experiment.duration = seconds;
  ExperimentRun run(scene, experiment, reference);
  while (run.advance()) {
  }
  return run.result();
}

TEST(RecommendedOfScenes, KeepsItsErrorAtItsCost) {
  for (const Scene& scene : scenes::shipped()) {
    if (!scene.recommended) continue;  // nothing is solved there
    SCOPED_TRACE(scene.name);
    const Recommended& kept = *scene.recommended;
    const Reference reference =
        kept.of == ErrorAxis::kTrajectory ? certain_reference(scene, kept) : no_reference();
    EXPECT_EQ(promise(reference, kept.within), kept.within);
    const Result result = run_for(scene, kept.seconds, reference);
    const auto error = error_of(result, kept.of);
    ASSERT_TRUE(error.has_value()) << result.metrics.verdict;
    EXPECT_LE(*error, kept.within);
    EXPECT_NEAR(*error, kept.reached, 0.01 * kept.reached);  // it has three digits
    const double operations = cost_of(result, CostAxis::kOperations);
    EXPECT_NEAR(operations, kept.operations, 0.01 * kept.operations);
  }
}

// The compared runs may have been shorter; the recommended one was tried for this long.
TEST(RecommendedOfScenes, HoldsForAsLongAsTheSceneIsJudged) {
  for (const Scene& scene : scenes::shipped()) {
    if (!scene.recommended || !scene.criteria.holds) continue;
    if (scene.recommended->seconds >= scene.criteria.duration) continue;
    const Result result = run_for(scene, scene.criteria.duration, no_reference());
    EXPECT_TRUE(result.metrics.holds) << scene.name << ": " << result.metrics.verdict;
  }
}

}  // namespace
}  // namespace substep
