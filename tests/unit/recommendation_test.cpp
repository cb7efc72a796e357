// What a recommendation rests on: the error that is compared, what the reference allows to promise,
// and runs of the whole duration.

#include "core/lab/recommendation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/io/experiment.hpp"
#include "core/lab/hold_search.hpp"
#include "core/lab/survey.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep {
namespace {

std::shared_ptr<const Scene> shared(Scene scene) {
  return std::make_shared<const Scene>(std::move(scene));
}

Result run_of(const Scene& scene, const Settings& settings, double seconds) {
  Experiment experiment = experiment_of(scene, settings);
  experiment.duration = seconds;
  ExperimentRun run(scene, experiment, no_reference());
  while (run.advance()) {
  }
  return run.result();
}

const Settings kOneStep = PaperSettings{.mode = Mode::kNone};

/// Runs of the swinging box for 0.2 s. The first and the last but one fail at 0.35 s.
std::vector<Result> short_runs() {
  const Scene scene = scenes::swinging_box();
  std::vector<Result> runs;
  for (const Settings& settings :
       {kOneStep, Settings(PaperSettings{.mode = Mode::kInertia, .n_cap = 3}), kOneStep,
        Settings(PaperSettings{.mode = Mode::kConst, .n = 24})}) {
    runs.push_back(run_of(scene, settings, 0.2));
    EXPECT_TRUE(runs.back().metrics.holds);
  }
  return runs;
}

void finish(HoldSearch& search) {
  while (search.advance(1e-3)) EXPECT_LE(search.progress(), 1.0);
  EXPECT_TRUE(search.done());
  EXPECT_EQ(search.progress(), 1.0);
  EXPECT_FALSE(search.advance(1e-3));
}

bool any(const Result&) { return true; }

TEST(HoldSearch, PassesOverRunsThatFailLater) {
  const auto scene = shared(scenes::swinging_box());
  HoldSearch search(scene, short_runs(), 0.6, no_reference(), any);
  EXPECT_FALSE(search.done());
  finish(search);
  EXPECT_EQ(search.found(), 1U);
  ASSERT_EQ(search.failed().size(), 1U);
  EXPECT_EQ(search.failed()[0].metrics.verdict.rfind("fails at 0.3", 0), 0U)
      << search.failed()[0].metrics.verdict;
  EXPECT_EQ(search.failed()[0].experiment.duration, 0.6);
}

TEST(HoldSearch, AsksWhetherTheWholeRunServes) {
  const auto scene = shared(scenes::swinging_box());
  HoldSearch search(scene, short_runs(), 0.6, no_reference(), [](const Result& result) {
    return result.experiment.settings.mode == Mode::kConst;
  });
  finish(search);
  EXPECT_EQ(search.found(), 3U);
  EXPECT_EQ(search.failed().size(), 3U);
  EXPECT_TRUE(search.failed()[1].metrics.holds) << "it holds, but does not serve";
}

TEST(HoldSearch, TakesRunsOfTheWholeDurationAsTheyAre) {
  const auto scene = shared(scenes::swinging_box());
  HoldSearch search(scene, short_runs(), 0.2, no_reference(), any);
  EXPECT_TRUE(search.done());
  EXPECT_EQ(search.found(), 0U);
  const HoldSearch none(scene, {}, 0.2, no_reference(), any);
  EXPECT_TRUE(none.done());
  EXPECT_FALSE(none.found().has_value());
}

TEST(HoldSearch, TriesALimitedNumber) {
  const auto scene = shared(scenes::swinging_box());
  const std::vector<Result> all(HoldSearch::kMost + 5, short_runs().front());
  HoldSearch search(scene, all, 0.6, no_reference(), any);
  finish(search);
  EXPECT_FALSE(search.found().has_value());
  EXPECT_EQ(search.failed().size(), HoldSearch::kMost);
}

TEST(Promise, IsTenTimesTheUncertaintyOfTheReference) {
  Reference reference;
  reference.uncertainty = 4e-4;
  reference.track = {Vec3::Zero(), Vec3::UnitX(), Vec3::Zero()};
  EXPECT_EQ(promise(reference, 1e-2), 1e-2);
  EXPECT_EQ(promise(reference, 4e-3), 4e-3);
  EXPECT_DOUBLE_EQ(promise(reference, 1e-3), 4e-3);
  reference.uncertainty = 1.6207e-5;
  EXPECT_DOUBLE_EQ(promise(reference, 1e-4), 1.7e-4) << "two digits, not less";
  reference.uncertainty = 0.1;
  EXPECT_TRUE(std::isinf(promise(reference, 1e-3))) << "the motion is no larger";
  EXPECT_EQ(promise(reference, 1.5), 1.5);
  reference.uncertainty = 0.0;
  EXPECT_EQ(promise(reference, 1e-15), 1e-15) << "exact";
  reference.failure = "fails at 0.1 s: ...";
  EXPECT_TRUE(std::isinf(promise(reference, 1.0)));
}

TEST(Survey, FindsTheBodyThatGetsFarthest) {
  const auto farthest = [](const Scene& scene, double seconds) {
    Survey survey(shared(scene), seconds);
    while (survey.advance()) {
    }
    return survey.farthest();
  };
  EXPECT_EQ(farthest(scenes::rope_of_n({.n = 4}), 0.5), 4) << "the box at the end";
  EXPECT_FALSE(farthest(scenes::rope_of_n({.n = 4}), 0.0).has_value());
  Scene rests = scenes::free_fall();
  rests.effects.gravity = false;
  rests.bodies[0].velocity = Vec3::Zero();
  EXPECT_FALSE(farthest(rests, 0.1).has_value()) << "it only rotates";
}

TEST(Survey, TellsWhetherBodiesTouch) {
  const auto touches = [](const Scene& scene) {
    Survey survey(shared(scene), 0.1);
    while (survey.advance()) {
    }
    return survey.touches();
  };
  EXPECT_TRUE(touches(scenes::heavy_stack()));
  EXPECT_FALSE(touches(scenes::bouncing_balls())) << "still in the air";
  EXPECT_FALSE(touches(scenes::pendulum()));
}

TEST(EnergyChanges, ByFrictionImpactsAndTorques) {
  EXPECT_EQ(energy_changes_by(scenes::pendulum()), "");
  EXPECT_EQ(energy_changes_by(scenes::crank_rocker()), "");
  EXPECT_EQ(energy_changes_by(scenes::heavy_stack()), "impacts");
  EXPECT_EQ(energy_changes_by(scenes::wall()), "friction");
  EXPECT_EQ(energy_changes_by(scenes::wall(), false), "") << "nothing touches";
  Scene balls = scenes::bouncing_balls();
  for (Body& body : balls.bodies) body.restitution = 1.0;
  for (Body& body : balls.bodies) body.friction = 0.0;
  EXPECT_EQ(energy_changes_by(balls), "");
  for (Body& body : balls.bodies) body.restitution = 0.5;
  EXPECT_EQ(energy_changes_by(balls), "impacts");
  balls.effects.restitution = false;
  for (Body& body : balls.bodies) body.restitution = 1.0;
  EXPECT_EQ(energy_changes_by(balls), "impacts") << "without the effect nothing bounces";
  Scene driven = scenes::pendulum();
  driven.bodies[0].torque = Vec3::UnitZ();
  driven.effects.external = true;
  EXPECT_EQ(energy_changes_by(driven), "a constant torque");
}

TEST(FirstAxis, IsEnergyOnlyWhereItIsKept) {
  Scene scene = scenes::pendulum();
  EXPECT_EQ(first_axis(scene), ErrorAxis::kTrajectory);
  scene.criteria.track.reset();
  EXPECT_EQ(first_axis(scene), ErrorAxis::kEnergy);
  Scene stack = scenes::heavy_stack();
  stack.criteria.track.reset();
  EXPECT_EQ(first_axis(stack), ErrorAxis::kPenetration);
  Scene dolls = scenes::ragdoll_drop();
  dolls.criteria.track.reset();
  EXPECT_EQ(first_axis(dolls), ErrorAxis::kGap);
}

}  // namespace
}  // namespace substep
