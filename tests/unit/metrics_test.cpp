// Measured quantities of a run, and its counted cost.

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/experiment.hpp"
#include "core/io/result.hpp"
#include "core/io/result_reader.hpp"
#include "core/lab/experiment_run.hpp"
#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

TEST(Metrics, MomentumIsMeasuredForAFreeTopAndNotForAPendulum) {
  const auto metrics = [](const Scene& scene) {
    const auto held = shared(scene);
    Experiment experiment = experiment_of(scene, scene.settings);
    experiment.duration = 1.0;
    const Reference reference = find_reference(held, 1.0);
    ExperimentRun run(scene, experiment, reference);
    while (run.advance()) {
    }
    return run.result().metrics;
  };
  const Metrics top = metrics(scenes::spinning_top());
  ASSERT_TRUE(top.errors.angular_momentum_drift.has_value());
  EXPECT_LT(*top.errors.angular_momentum_drift, 1e-10);
  EXPECT_LT(std::abs(*top.errors.energy_drift_percent), 1e-9);
  EXPECT_FALSE(top.errors.joint_gap.has_value());
  const Metrics pendulum = metrics(scenes::pendulum());
  EXPECT_FALSE(pendulum.errors.angular_momentum_drift.has_value());
  EXPECT_TRUE(pendulum.errors.joint_gap.has_value());
  EXPECT_EQ(pendulum.work.frames, 60);
  EXPECT_GT(pendulum.timing.ms_median, 0.0);
  EXPECT_GE(pendulum.timing.ms_p95, pendulum.timing.ms_median);
}

TEST(Metrics, AFailedRunEndsThereAndHasNoTrajectoryError) {
  const Scene scene = scenes::swinging_box();
  const auto held = shared(scene);
  Settings settings;
  settings.mode = Mode::kNone;
  const Reference reference = find_reference(held, 0.5);
  ExperimentRun run(scene, experiment_of(scene, settings), reference);
  while (run.advance()) {
  }
  const Metrics m = run.result().metrics;
  EXPECT_FALSE(m.holds);
  EXPECT_NEAR(m.failed_at, 0.35, 0.035);
  EXPECT_EQ(m.work.frames, std::llround(m.failed_at * 60.0));
  EXPECT_FALSE(m.errors.trajectory_peak.has_value());
  const Json json = result_json(run.result());
  EXPECT_EQ(json["holds"], false);
  Problems problems;
  EXPECT_EQ(read_result(json, problems), run.experiment());
  EXPECT_EQ(problems.size(), 0U);
}

Work work_of(const Scene& scene, const Settings& settings, double seconds) {
  Experiment experiment = experiment_of(scene, settings);
  experiment.duration = seconds;
  const Reference reference;
  ExperimentRun run(scene, experiment, reference);
  while (run.advance()) {
  }
  return run.result().metrics.work;
}

TEST(Work, FlopsFollowFromSizesAlone) {
  // Pinned hinges in a row: a run's flops are a constant per solve.
  const Scene scene = scenes::rope_of_n({.n = 6});
  const auto work = [&](const Settings& settings, double seconds) {
    return work_of(scene, settings, seconds);
  };
  Settings settings;
  settings.mode = Mode::kConst;
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    settings.solver = solver;
    settings.n = 3;
    const Work once = work(settings, 0.1);
    settings.n = 6;
    const Work twice = work(settings, 0.1);
    EXPECT_GT(once.flops, 0);
    EXPECT_EQ(once.flops % once.solves, 0);
    EXPECT_EQ(twice.flops, 2 * once.flops);
    EXPECT_EQ(twice.row_updates, 2 * once.row_updates);
    EXPECT_EQ(once.substeps, 18);
  }
  EXPECT_EQ(work(settings, 0.1), work(settings, 0.1)) << "the work is reproducible";
}

TEST(Work, GaussSeidelVisitsEveryRowOnceAnIteration) {
  Settings settings;
  settings.solver = SolverKind::kPgs;
  settings.iterations = 7;
  const Work work = work_of(scenes::bridge(), settings, 0.5);
  EXPECT_GT(work.rows.joint, 0);
  EXPECT_GT(work.rows.contact, 0);
  EXPECT_EQ(work.rows.friction, 2 * work.rows.contact);
  EXPECT_EQ(work.rows.grab, 0);
  EXPECT_EQ(work.row_updates, 7 * (work.rows.joint + work.rows.contact + work.rows.friction));
  EXPECT_EQ(work_of(scenes::swinging_box(), settings, 0.1).rows.joint % 130, 0);
}

// Twelve times the bricks are twelve times the visits: nothing looks for anything one by one.
TEST(Work, VisitsAreProportionalToTheBodies) {
  for (const Detection detection :
       {Detection::kFrame, Detection::kSubstep, Detection::kContinuous}) {
    SCOPED_TRACE(std::string(name_of(detection)));
    const auto visits = [&](int bricks) {
      scenes::WallOptions options;
      options.courses = 3;
      options.bricks = bricks;
      Settings settings{.solver = SolverKind::kPgs, .mode = Mode::kConst, .n = 2};
      settings.detection = detection;
      return static_cast<double>(work_of(scenes::wall(options), settings, 0.2).visits);
    };
    const double few = visits(10);
    EXPECT_GT(few, 10.0 * 30.0);
    EXPECT_LT(visits(120), 1.5 * 12.0 * few);
  }
}

TEST(Work, AGrabAddsItsOwnRows) {
  const Scene scene = scenes::rope_of_n({.n = 4});
  Simulator simulator(shared(scene));
  const auto rows = [&] { return simulator.step().work.rows; };
  Settings settings;
  settings.mode = Mode::kConst;
  settings.n = 2;
  simulator.set_settings(settings);
  const RowCounts free = rows();
  simulator.set_grab(Grab{.body = 2});
  const RowCounts held = rows();
  EXPECT_EQ(free.grab, 0);
  EXPECT_EQ(held.grab, 2 * 3);
  EXPECT_EQ(held.joint, free.joint);
}

TEST(Work, TheCriterionIsCountedOncePerEvaluation) {
  const Scene scene = scenes::swinging_box();
  Settings settings;
  settings.mode = Mode::kConst;
  EXPECT_EQ(work_of(scene, settings, 0.5).criterion, CriterionWork{});
  settings.mode = Mode::kAdaptive;
  const Work by_frame = work_of(scene, settings, 0.5);
  EXPECT_EQ(by_frame.criterion.evaluations, by_frame.frames + 1) << "including the probe";
  settings.policy = Policy::kSubstep;
  const Work by_substep = work_of(scene, settings, 0.5);
  EXPECT_EQ(by_substep.criterion.evaluations, by_substep.substeps + 1);
  EXPECT_EQ(by_substep.criterion.flops / by_substep.criterion.evaluations,
            by_frame.criterion.flops / by_frame.criterion.evaluations);
}

}  // namespace
}  // namespace substep::test
