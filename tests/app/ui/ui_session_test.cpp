#include "app/lab/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ranges>

#include "core/io/scene_writer.hpp"
#include "core/model/names.hpp"
#include "core/model/validate.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(Session, TakesAsManyFramesAsWallTimeAllowsAtAnyRefreshRate) {
  for (const double rate : {30.0, 59.94, 60.0, 75.0, 144.0, 240.0}) {
    Session session(shipped("pendulum"));
    session.play();
    int frames = 0;
    const int calls = static_cast<int>(2.0 * rate);
    for (int i = 0; i < calls; ++i) frames += session.advance(1.0 / rate);
    EXPECT_NEAR(frames, 60.0 * calls / rate, 1.01) << rate << " Hz";
  }
}

TEST(Session, SpeedScalesTheTime) {
  Session session(shipped("pendulum"));
  session.set_speed(0.25);
  session.play();
  int frames = 0;
  for (int i = 0; i < 240; ++i) frames += session.advance(kFrame);
  EXPECT_NEAR(frames, 60, 1);
}

// Without a budget a call takes one frame, however much time has passed.
TEST(Session, PaceIsTheRateOfTheLastSecondsFromTheFirstCallOn) {
  Session session(shipped("pendulum"));
  EXPECT_EQ(session.pace(), 1.0);
  session.play();
  for (int i = 0; i < 10; ++i) session.advance(10.0 * kFrame, 0.0);
  EXPECT_NEAR(session.pace(), 0.1, 0.02);
  for (int i = 0; i < 60; ++i) session.advance(kFrame, 10.0);  // faster for one second
  EXPECT_GT(session.pace(), 0.3);
  for (int i = 0; i < 1200; ++i) session.advance(kFrame, 10.0);
  EXPECT_GT(session.pace(), 0.99);
  session.set_speed(0.1);
  for (int i = 0; i < 1200; ++i) session.advance(kFrame, 10.0);
  EXPECT_NEAR(session.pace(), 1.0, 1e-6) << "of the chosen speed";
  session.reset();
  EXPECT_EQ(session.pace(), 1.0);
}

TEST(Session, LongAbsenceBringsNoBacklog) {
  Session session(shipped("pendulum"));
  session.play();
  const int frames = session.advance(3600.0, 10.0);
  EXPECT_LE(frames, 7);
  EXPECT_LE(session.advance(kFrame, 10.0), 2);
}

TEST(Session, RefreshRateDoesNotChangeTheMotion) {
  Session smooth(shipped("swinging_box"));
  Session coarse(shipped("swinging_box"));
  smooth.play();
  coarse.play();
  while (smooth.state().frame < 30) smooth.advance(1.0 / 240.0, 10.0);
  while (coarse.state().frame < 30) coarse.advance(1.0 / 61.0, 10.0);
  ASSERT_EQ(smooth.state().frame, coarse.state().frame);
  EXPECT_EQ(smooth.hash(), coarse.hash());
}

TEST(Session, ResetIsTheStart) {
  Session session(shipped("bridge"));
  const std::uint64_t start = session.hash();
  for (int i = 0; i < 20; ++i) session.step();
  EXPECT_NE(session.hash(), start);
  const std::uint64_t later = session.hash();
  session.reset();
  EXPECT_EQ(session.hash(), start);
  EXPECT_EQ(session.history().size(), 0U);
  for (int i = 0; i < 20; ++i) session.step();
  EXPECT_EQ(session.hash(), later);
}

TEST(Session, PosesLieBetweenTheLastTwoFrames) {
  Session session(shipped("free_fall"));
  session.play();
  session.advance(2.5 * kFrame, 10.0);
  const double before = session.scene().bodies.front().is_static ? 1 : 0;
  const auto ball = static_cast<std::size_t>(before);
  const double now = session.state().x[ball].y();
  const double shown = session.poses().x[ball].y();
  EXPECT_GT(shown, now);
  session.pause();
  session.advance(kFrame);
  EXPECT_EQ(session.poses().x[ball].y(), now);
}

TEST(Session, VerdictOfUnprotectedSwingingBoxFails) {
  Session session(shipped("swinging_box"));
  Settings s = session.settings();
  s.mode = Mode::kNone;
  session.set_settings(s);
  for (int i = 0; i < 120; ++i) session.step();
  EXPECT_FALSE(session.verdict().holds());
  session.reset();
  EXPECT_TRUE(session.verdict().holds());
  EXPECT_EQ(session.settings().mode, Mode::kNone);
}

void take(Session& session, int frames) {
  for (int i = 0; i < frames; ++i) session.step();
}

TEST(Past, RunContinuesFromItBitForBit) {
  for (const char* scene : {"swinging_box", "bridge", "heavy_stack"}) {
    Session straight(shipped(scene));
    take(straight, 40);
    Session session(shipped(scene));
    take(session, 30);
    const auto history = session.history().size();
    session.go_to(10);
    EXPECT_EQ(session.state().frame, 10);
    EXPECT_EQ(session.report().frame, 10);
    EXPECT_FALSE(session.timeline().at_end());
    EXPECT_EQ(session.history().size(), history) << "viewing the past drops nothing";
    session.play();
    while (session.state().frame < 40) session.advance(kFrame, 10.0);
    EXPECT_EQ(session.hash(), straight.hash()) << scene;
    EXPECT_EQ(session.verdict().text(), straight.verdict().text());
    EXPECT_EQ(session.report().energy, straight.report().energy);
    ASSERT_EQ(session.history().size(), straight.history().size());
    for (const Channel channel : {Channel::kSubsteps, Channel::kKinetic, Channel::kJointError}) {
      EXPECT_TRUE(std::ranges::equal(session.history()[channel], straight.history()[channel]));
    }
  }
}

TEST(Past, VerdictIsWithdrawnAndReachedAgain) {
  Session session(shipped("swinging_box"));
  Settings s = session.settings();
  s.mode = Mode::kNone;
  session.set_settings(s);
  take(session, 40);
  ASSERT_FALSE(session.verdict().holds());
  const std::string text = session.verdict().text();
  session.go_to_last_good();
  EXPECT_TRUE(session.verdict().holds());
  const auto good = session.state().frame;
  EXPECT_LT(session.state().time, session.timeline().last().verdict.failed_at());
  session.go_to_last_good(0.2);
  EXPECT_EQ(session.state().frame, good - 12);
  while (session.state().frame < 40) session.step();
  EXPECT_EQ(session.verdict().text(), text);
}

TEST(Past, OneForwardIsTheFrameThatFollowedUnlessSomethingChanged) {
  Session session(shipped("swinging_box"));
  take(session, 20);
  const std::uint64_t end = session.hash();
  session.step_back();
  session.step_back();
  EXPECT_EQ(session.state().frame, 18);
  session.step();
  EXPECT_EQ(session.timeline().size(), 21U);
  session.step();
  EXPECT_EQ(session.hash(), end);
  session.step_back();
  Settings s = session.settings();
  s.alpha = 0.5;
  session.set_settings(s);
  session.step_back();
  session.step();
  EXPECT_EQ(session.state().frame, 19);
  EXPECT_TRUE(session.timeline().at_end()) << "frames of another alpha are dropped";
  EXPECT_EQ(session.history().size(), 19U);
}

TEST(Past, TrailIsThatOfTheMoment) {
  Session session(shipped("swinging_box"));
  take(session, 30);
  session.go_to(12);
  const std::deque<Vec3> rewound = session.trail();
  Session straight(shipped("swinging_box"));
  take(straight, 12);
  ASSERT_EQ(rewound.size(), straight.trail().size());
  for (std::size_t i = 0; i < rewound.size(); ++i) EXPECT_EQ(rewound[i], straight.trail()[i]);
}

TEST(Past, KeepsToItsShareOfMemoryAndToTheStart) {
  constexpr std::size_t kShare = std::size_t{1} << 20U;
  Session session(shipped("swinging_box"), kShare);
  take(session, 600);
  const Timeline& past = session.timeline();
  EXPECT_LE(past.bytes(), kShare);
  EXPECT_GT(past.bytes(), kShare / 2);
  EXPECT_EQ(past[0].state.frame, 0);
  EXPECT_EQ(past.last().state.frame, 600);
  EXPECT_EQ(past[past.size() - 2].state.frame, 599);
  for (std::size_t i = 1; i < past.size(); ++i) {
    EXPECT_GT(past[i].state.frame, past[i - 1].state.frame);
  }
  // A run continues exactly from any stored moment, however sparse its neighbours are.
  Session straight(shipped("swinging_box"));
  take(straight, 600);
  session.go_to(past.size() / 4);
  session.play();
  while (session.state().frame < 600) session.advance(kFrame, 10.0);
  EXPECT_EQ(session.hash(), straight.hash());
}

TEST(Past, IsFoundByTime) {
  Session session(shipped("pendulum"));
  take(session, 60);
  const Timeline& past = session.timeline();
  EXPECT_EQ(past.at_time(-1.0), 0U);
  EXPECT_EQ(past.at_time(0.5), 30U);
  EXPECT_EQ(past.at_time(0.5 + 0.4 * kFrame), 30U);
  EXPECT_EQ(past.at_time(100.0), 60U);
}

// A recommendation is of the scene that was swept, not of the same without gravity.
TEST(Session, SavedAfterAnEditItHasNoRecommendation) {
  Session session(shipped("swinging_box"));
  ASSERT_TRUE(session.loaded().recommended.has_value());
  EXPECT_EQ(session.as_scene().recommended, session.loaded().recommended);
  Effects effects = session.scene().effects;
  effects.gravity = false;
  session.set_effects(effects);
  EXPECT_FALSE(session.as_scene().recommended.has_value());
  session.reset();
  EXPECT_TRUE(session.as_scene().recommended.has_value());
}

TEST(Substep, ContinuesToTheSameFrame) {
  Session whole(shipped("swinging_box"));
  Session pieces(shipped("swinging_box"));
  take(whole, 3);
  for (int frame = 0; frame < 3; ++frame) {
    pieces.substep();
    ASSERT_GT(pieces.substeps_left(), 0);
    EXPECT_EQ(pieces.state().frame, frame);
    EXPECT_EQ(pieces.timeline().last().state.frame, frame) << "the past has whole frames only";
    pieces.step();
  }
  EXPECT_EQ(pieces.hash(), whole.hash());
  EXPECT_EQ(pieces.history().size(), whole.history().size());
  pieces.substep();
  pieces.step_back();
  EXPECT_EQ(pieces.hash(), whole.hash()) << "back to the start of the frame";
}

TEST(Hand, HoldingABodyDisturbsTheRunUntilAReset) {
  Session session(shipped("swinging_box"));
  take(session, 5);
  const auto box = session.scene().bodies.size() - 1;
  session.grab(static_cast<int>(box), Vec3::Zero(), session.state().x[box] + Vec3(0, 5, 0));
  take(session, 60);
  EXPECT_TRUE(session.verdict().disturbed());
  EXPECT_EQ(session.verdict().text(), "disturbed at 0.08 s");
  EXPECT_TRUE(session.verdict().holds());
  Session alone(shipped("swinging_box"));
  take(alone, 65);
  EXPECT_GT(session.state().x[box].y(), alone.state().x[box].y() + 0.3) << "it was pulled up";
  session.reset();
  EXPECT_FALSE(session.held());
  take(session, 65);
  EXPECT_EQ(session.hash(), alone.hash());
  EXPECT_EQ(session.verdict().text(), "holds");
}

TEST(Hand, EnergyFromItIsNoFailure) {
  Scene scene = *shipped("swinging_box");
  scene.criteria.energy_gain = 10.0;
  Session session(std::make_shared<const Scene>(scene));
  const auto box = session.scene().bodies.size() - 1;
  session.grab(static_cast<int>(box), Vec3::Zero(), session.state().x[box] + Vec3(0, 5, 0));
  take(session, 30);
  EXPECT_GT(session.report().energy - session.timeline()[0].report.energy, 10.0);
  EXPECT_TRUE(session.verdict().holds());
}

// A frame of 400 sub-steps, in slices that end after some of them.
Settings long_frames() {
  PaperSettings settings;
  settings.mode = Mode::kConst;
  settings.n = 400;
  settings.solver = SolverKind::kPgs;
  settings.iterations = 2000;
  return settings;
}

TEST(Slices, OfAFrameAreTheSameBits) {
  Session session(shipped("swinging_box"));
  session.set_settings(long_frames());
  session.play();
  int calls = 0;
  for (; session.state().frame < 2; ++calls) session.advance(1.0 / 60.0, 0.0);
  EXPECT_GT(calls, 20);
  Simulator whole(shipped("swinging_box"));
  whole.set_settings(long_frames());
  for (int i = 0; i < 2; ++i) whole.step();
  session.pause();
  EXPECT_EQ(state_hash(session.state()), state_hash(whole.state()));
}

TEST(Slices, OfAnAbandonedFrameChangeNothing) {
  Session session(shipped("swinging_box"));
  take(session, 3);
  const std::uint64_t before = session.hash();
  session.set_settings(long_frames());
  const auto begin = [&] {
    session.play();
    for (int i = 0; i < 3; ++i) session.advance(1.0 / 60.0, 0.0);
    ASSERT_TRUE(session.slices().open());
    EXPECT_GT(session.slices().taken(), 0);
    EXPECT_EQ(session.hash(), before) << "the last complete frame is shown";
    EXPECT_EQ(session.substeps_left(), 0) << "nobody takes single sub-steps";
  };
  begin();
  session.pause();
  EXPECT_EQ(session.hash(), before);
  EXPECT_EQ(session.substeps_left(), 0);
  begin();
  session.throw_ball({{0.0, 9.0, 20.0}});
  EXPECT_EQ(session.balls(), 1U);
  EXPECT_EQ(session.state().frame, 3);
  session.pause();
  session.go_to(3);
  begin();
  session.set_settings(PaperSettings{});  // the frame restarts with them
  EXPECT_FALSE(session.slices().open());
  EXPECT_EQ(session.hash(), before);
  session.step();
  Session other(shipped("swinging_box"));
  take(other, 3);
  other.set_settings(PaperSettings{});
  take(other, 1);
  EXPECT_EQ(session.hash(), other.hash());
}

TEST(Slices, ARequestedFrameIsOne) {
  Session session(shipped("swinging_box"));
  session.set_settings(long_frames());
  session.request_step();
  for (int i = 0; i < 500 && session.playing(); ++i) session.advance(1.0 / 60.0);
  EXPECT_FALSE(session.playing());
  EXPECT_EQ(session.state().frame, 1);
}

TEST(Slices, AHandActsFromTheNextFrameOn) {
  Session session(shipped("pendulum"));
  Settings settings = long_frames();
  settings.iterations = 20000;
  session.set_settings(settings);
  session.play();
  session.advance(1.0 / 60.0, 0.0);
  ASSERT_TRUE(session.slices().open());
  const int taken = session.slices().taken();
  session.grab(static_cast<int>(session.scene().bodies.size()) - 1, Vec3::Zero(), Vec3::Ones());
  session.advance(1.0 / 60.0, 0.0);
  EXPECT_GT(session.slices().taken(), taken) << "the frame continues";
  EXPECT_TRUE(session.held());
}

TEST(HeavyStart, ALinkToOneWaitsForConfirmation) {
  Headless h;
  h.app->session.play();
  h.app->open_link("scene=swinging_box&solver=pgs&iterations=400&mode=const&n=10000");
  EXPECT_FALSE(h.app->session.playing());
  EXPECT_NE(h.app->heavy.why.find("10,000 sub-steps"), std::string::npos) << h.app->heavy.why;
  h.frames(2);
  ASSERT_NE(find_handle("Run it"), nullptr);
  h.app->session.play();
  for (int i = 0; i < 60; ++i) h.frames(1);
  EXPECT_TRUE(h.app->session.slices().open());
  ASSERT_NE(find_handle("Cancel"), nullptr);
  h.app->session.pause();
  EXPECT_EQ(h.app->session.state().frame, 0);
  h.app->open_link("scene=pendulum");
  EXPECT_EQ(h.app->heavy.why, "");
}

TEST(HeavyStart, GoesBackToTheRunBefore) {
  Headless h;
  h.app->open_link("scene=bridge&alpha=0.15&load=2&seed=3");
  h.app->session.play();
  const std::string before = h.app->link();
  h.app->open_link("scene=swinging_box&solver=pgs&iterations=400&mode=const&n=10000");
  h.app->open_link("scene=swinging_box&solver=pgs&iterations=500&mode=const&n=10000");
  ASSERT_TRUE(h.app->held());
  h.frames(2);
  ASSERT_NE(find_handle("Go back"), nullptr);
  h.press("Go back");
  EXPECT_EQ(h.app->link(), before) << "the last run that the user saw";
  EXPECT_TRUE(h.app->session.playing());
  EXPECT_FALSE(h.app->held());
}

TEST(HeavyStart, ASceneInsideALinkIsOneWithItsSettings) {
  Headless h;
  Scene own = *shipped("pendulum");
  own.name = "own_pendulum";
  const std::string text = write_scene(own);
  h.app->open_link("mode=const&n=10000&solver=pgs&iterations=2000", read_scene(text));
  EXPECT_EQ(h.app->session.scene().name, "own_pendulum");
  ASSERT_TRUE(h.app->held()) << "only its settings make it heavy";
  EXPECT_NE(h.app->heavy.before.scene->name, "own_pendulum");
  h.app->open_link("alpha=0.3", read_scene("{}"));
  EXPECT_NE(h.app->trouble.title.find("link's scene"), std::string::npos);
  EXPECT_NE(h.app->session.settings().alpha, 0.3);
}

TEST(HeavyStart, ARunThatWouldStopAtOnceIsReported) {
  Headless h;
  h.app->open_link("scene=swinging_box&solver=pgs&iterations=100000&mode=const&n=10000");
  EXPECT_FALSE(h.app->session.playing());
  EXPECT_NE(h.app->heavy.why.find("100000 iterations"), std::string::npos) << h.app->heavy.why;
  h.app->session.play();
  h.frames(3);
  EXPECT_EQ(h.app->session.report().status, StepStatus::kOverBudget);
  EXPECT_EQ(h.app->session.state().frame, 0);
}

Ball ball_at(const Vec3& position, const Vec3& velocity) {
  Ball ball;
  ball.position = position;
  ball.velocity = velocity;
  return ball;
}

TEST(Hand, ThrownBallHitsBodiesOfASceneWithoutContact) {
  Session session(shipped("swinging_box"));
  ASSERT_FALSE(session.scene().effects.contact);
  take(session, 10);
  const auto box = session.scene().bodies.size() - 1;
  const Vec3 x = session.state().x[box];
  const Vec3 v = session.state().u[box].head<3>();
  session.throw_ball(ball_at(x + Vec3(0.0, 0.0, 4.0), v + Vec3(0.0, 0.0, -12.0)));
  EXPECT_EQ(session.balls(), 1U);
  EXPECT_TRUE(session.scene().effects.contact);
  bool touched = false;
  for (int i = 0; i < 60; ++i) {
    session.step();
    for (const ContactForce& c : session.forces().contacts) {
      EXPECT_EQ(std::max(c.a, c.b), static_cast<int>(box) + 1) << "only the ball touches";
      touched = touched || c.gap < 1e-3;
    }
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(session.state().x[box + 1].z(), -1.0) << "12 m/s would have taken it 8 m behind";
  EXPECT_LT(session.report().joint_gap, 0.1);
  EXPECT_TRUE(session.verdict().disturbed());
  session.go_to(5);
  EXPECT_EQ(session.balls(), 0U) << "before the throw there was none";
  session.reset();
  EXPECT_EQ(session.scene().bodies.size(), box + 1);
}

TEST(Hand, ABallIsThrownInEverySceneWithEveryIntegrator) {
  const Library library = shipped();
  for (const auto& scene : library.scenes()) {
    for (const auto& integrator : kIntegrators) {
      Session session(scene);
      Settings settings = session.settings();
      settings.integrator = integrator.value;
      session.set_settings(settings);
      take(session, 2);
      session.throw_ball(ball_at({0.0, 9.0, 20.0}, Vec3::Zero()));
      const Problems problems = validate(session.state(), session.scene());
      EXPECT_TRUE(problems.empty()) << scene->name << ", " << integrator.name << ": "
                                    << problems.front().pointer << problems.front().message;
      take(session, 1);
      EXPECT_EQ(session.report().status, StepStatus::kOk) << scene->name;
    }
  }
}

// Every per-body array of the state also has an entry for the ball.
TEST(Hand, ABallIsThrownInEveryMode) {
  for (const auto& mode : kModes) {
    Session session(shipped("bridge"));
    Settings settings = session.settings();
    settings.mode = mode.value;
    session.set_settings(settings);
    take(session, 3);
    session.throw_ball(ball_at({0.0, 9.0, 2.0}, Vec3::Zero()));
    const State& state = session.state();
    EXPECT_TRUE(validate(state, session.scene()).empty()) << mode.name;
    take(session, 3);
    EXPECT_EQ(session.report().status, StepStatus::kOk) << mode.name;
  }
}

TEST(Hand, TheOldestBallIsRemoved) {
  Session session(shipped("heavy_stack"));
  const std::size_t bodies = session.scene().bodies.size();
  for (int i = 0; i < Ball::kMost + 3; ++i) {
    session.throw_ball(ball_at({3.0 + 2.0 * i, 5.0, 0.0}, Vec3::Zero()));
    session.step();
  }
  EXPECT_EQ(session.balls(), static_cast<std::size_t>(Ball::kMost));
  EXPECT_NEAR(session.state().x[bodies + 2].x(), 3.0 + 2.0 * (Ball::kMost + 2), 1e-3);
  EXPECT_EQ(session.report().status, StepStatus::kOk);
}

TEST(Hand, EffectsAreSwitchedOffWhileItRunsAndBackByAReset) {
  Session session(shipped("swinging_box"));
  take(session, 20);
  const auto box = session.scene().bodies.size() - 1;
  Effects effects = session.scene().effects;
  effects.joints = false;
  session.set_effects(effects);
  const Vec3 v = session.state().u[box].head<3>();
  take(session, 30);
  EXPECT_TRUE(session.forces().joints.empty());
  const Vec3 fallen = v + 0.5 * Vec3(0.0, -9.81, 0.0);
  EXPECT_LT((session.state().u[box].head<3>() - fallen).norm(), 1e-6) << "it falls freely";
  EXPECT_TRUE(session.verdict().disturbed());
  session.reset();
  EXPECT_TRUE(session.scene().effects.joints);
  EXPECT_FALSE(session.verdict().disturbed());
}

}  // namespace
}  // namespace substep
