// A failing run stops cleanly, and the suggested remedy works.

#include <gtest/gtest.h>

#include <cmath>

#include "core/lab/remedy.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

bool all_finite(const State& state) {
  double sum = state.time + state.dt_previous + state.r;
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    sum += state.x[i].sum() + state.q[i].coeffs().sum() + state.u[i].sum();
    sum += state.u_synchronised[i].sum();
  }
  return std::isfinite(sum);
}

TEST(Divergence, StopsAtTheLastFiniteState) {
  Simulator simulator(std::make_shared<const Scene>(scenes::swinging_box()));
  State thrown = simulator.state();
  thrown.u.back().head<3>() = Vec3{1e200, 0.0, 0.0};  // a speed whose square overflows
  simulator.set_state(thrown);
  FrameReport report;
  for (int frame = 0; frame < 100 && report.status == StepStatus::kOk; ++frame) {
    report = simulator.step();
    ASSERT_TRUE(all_finite(simulator.state())) << frame;
  }
  ASSERT_EQ(report.status, StepStatus::kNotFinite);
  EXPECT_GE(report.failed_body, 0);
}

TEST(Divergence, WithinAFrameReportsTheTimeOfItsPoses) {
  const auto scene = std::make_shared<const Scene>(scenes::swinging_box());
  Simulator simulator = simulator_of(scene, {.mode = Mode::kConst, .n = 16});
  simulator.step();
  for (int i = 0; i < 3; ++i) simulator.substep();
  Grab grab;
  grab.body = 1;
  ASSERT_FALSE(scene->bodies[1].is_static);
  grab.anchor = {1e200, 0.0, 0.0};  // an arm whose square overflows
  grab.mass = 1e10;
  simulator.set_grab(grab);
  const FrameReport report = simulator.step();
  ASSERT_EQ(report.status, StepStatus::kNotFinite);
  EXPECT_TRUE(all_finite(simulator.state()));
  EXPECT_EQ(report.time, simulator.state().time);
  EXPECT_NEAR(report.time, (1.0 + 3.0 / 16.0) * scene->frame, 1e-14);
}

TEST(TooManyContacts, StopTheRunBeforeMemoryIsAllocated) {
  Scene scene;
  scene.name = "crowd";
  scene.effects = {.gravity = true, .joints = true, .contact = true};
  BallJoint tie;
  tie.name = "tie";
  tie.a = 0;
  tie.b = 1;
  scene.joints.emplace_back(tie);
  for (int i = 0; i < 700; ++i) {  // all at one point: 244,650 pairs
    Body body;
    body.name = "ball_" + std::to_string(i);
    body.inertia = solid_inertia(body.shape, body.mass);
    scene.bodies.push_back(body);
  }
  const auto shared = std::make_shared<const Scene>(scene);
  Simulator simulator(shared);
  const State start = simulator.state();
  Verdict verdict(*shared, start, simulator.observe());
  const FrameReport report = simulator.step();
  EXPECT_EQ(report.status, StepStatus::kTooManyContacts);
  EXPECT_EQ(simulator.state().frame, 0);
  EXPECT_EQ(state_hash(simulator.state()), state_hash(start));
  EXPECT_TRUE(simulator.constraint_forces().joints.empty()) << "nothing was solved";
  verdict.add(*shared, simulator.state(), report);
  EXPECT_TRUE(verdict.stopped());
  EXPECT_EQ(
      verdict.text(),
      "fails at 0.000 s: more than 200000 contacts or 1000000 pairs of bodies near each other");
}

/// The result of the first remedy for a failed run.
void expect_helped(const Scene& scene, const Settings& settings) {
  FrameReport failed;
  const Outcome before = run(scene, settings, scene.criteria.duration,
                             [&](const Simulator&, const FrameReport& report) { failed = report; });
  ASSERT_FALSE(before.holds) << scene.name;
  const auto all = remedies(settings, failed, {});
  ASSERT_FALSE(all.empty());
  const Outcome after = run(scene, all.front().settings, scene.criteria.duration);
  EXPECT_TRUE(after.holds) << scene.name << ": " << all.front().text << ": " << after.verdict;
}

// The first solve of a long step has no initial active set, and its pivots run out.
TEST(PivotsThatRunOut, LeaveAHouseOfCardsStanding) {
  Simulator simulator = simulator_of(scenes::card_house(), {.mode = Mode::kNone});
  const double start = simulator.observe().energy;
  FrameReport report = simulator.step();
  EXPECT_EQ(report.work.unsolved, 1) << "otherwise the test is vacuous";
  EXPECT_LT(report.energy, start + 1e-3);
  for (int frame = 1; frame < 240; ++frame) report = simulator.step();
  EXPECT_LT(report.energy, start);
  EXPECT_GT(report.energy, start - 1.0) << "the house has fallen";
}

TEST(Remedies, AdaptiveSubstepsHelpWhereThereAreTooFew) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::bridge()}) {
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      expect_helped(scene, {.solver = solver, .mode = Mode::kNone});
    }
    expect_helped(scene, {.mode = Mode::kConst, .n = 4});
  }
}

TEST(Remedies, ALargerCapHelpsWhereItWasInForce) {
  expect_helped(scenes::swinging_box(), {.n_max = 4});
}

TEST(Remedies, ASmallerAlphaHelpsTheTallStack) {
  Scene scene = scenes::heavy_stack_stress_tall();
  expect_helped(scene, {.alpha = 0.1});
}

TEST(Remedies, TheSoftDriftLawHelpsSweeps) {
  expect_helped(scenes::swinging_box(), {.solver = SolverKind::kPgs, .drift = Drift::kFull});
}

TEST(Remedies, TheDirectSolverIsOneWhereSweepsAreNotEnough) {
  Settings settings{.solver = SolverKind::kPgs};
  const auto all = remedies(settings, {}, {});
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Remedy& remedy) {
    return remedy.settings.solver == SolverKind::kBpp;
  }));
  const Outcome after = run(scenes::heavy_stack(), all.front().settings, 2.0);
  EXPECT_TRUE(after.holds) << after.verdict;
}

TEST(Remedies, TheImplicitTorqueHelpsATopThatExplodes) {
  Scene scene = scenes::spinning_top();
  for (Body& body : scene.bodies) body.angular_velocity = {300.0, 2000.0, 100.0};
  expect_helped(scene, {.mode = Mode::kNone, .gyroscopic = Gyroscopic::kExplicit});
}

TEST(Remedies, AreEmptyWhenNoSettingIsLeftToChange) {
  const Settings settings{.alpha = 1e-3, .policy = Policy::kSubstep};
  const auto all = remedies(settings, {}, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].settings, substep::Settings{});
  FrameReport over_budget;
  over_budget.status = StepStatus::kOverBudget;
  EXPECT_TRUE(remedies(settings, over_budget, {}).empty());
}

TEST(Remedies, AgainstGainsAndOverlapsAreNoSmallerAlpha) {
  for (const auto what :
       {Exceeded::What::kEnergyGain, Exceeded::What::kOverlap, Exceeded::What::kPassage}) {
    Exceeded exceeded;
    exceeded.what = what;
    const auto all = remedies(Settings{}, {}, exceeded);
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all[0].settings, substep::Settings{});
    for (const Remedy& remedy : all) EXPECT_EQ(remedy.settings.alpha, 0.1) << remedy.text;
  }
}

// What is offered as tried has held; what has not is left out.
TEST(Remedies, ThatAreTriedHoldForTheWholeRun) {
  const Scene scene = scenes::swinging_box();
  const Settings settings{.mode = Mode::kNone};
  FrameReport failed;
  run(scene, settings, 10.0, [&](const Simulator&, const FrameReport& report) { failed = report; });
  const std::vector<Remedy> all = remedies(settings, failed, {});
  const auto tried_by = [&](const Trial& trial) {
    RemedyTrials trials(shared(scene), all, trial);
    while (trials.advance()) {
    }
    EXPECT_TRUE(trials.done());
    return trials;
  };
  const RemedyTrials tried = tried_by({.frames = 600, .enough = 10});
  EXPECT_EQ(tried.failed() + static_cast<int>(tried.hold().size()), static_cast<int>(all.size()));
  ASSERT_GE(tried.hold().size(), 2U);
  for (const Remedy& remedy : tried.hold()) {
    EXPECT_TRUE(run(scene, remedy.settings, 10.0).holds) << remedy.text;
  }
  EXPECT_EQ(tried_by({.frames = 600, .enough = 1}).hold().size(), 1U);
  const RemedyTrials costly = tried_by({.frames = 600, .most_work = 1000.0});
  EXPECT_TRUE(costly.hold().empty());
  EXPECT_EQ(costly.failed(), 0);
}

TEST(Remedies, AreEmptyForTooManyContacts) {
  FrameReport failed;
  failed.status = StepStatus::kTooManyContacts;
  EXPECT_TRUE(remedies({}, failed, {}).empty());
}

}  // namespace
}  // namespace substep::test
