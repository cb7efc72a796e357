#include "app/session.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace substep
