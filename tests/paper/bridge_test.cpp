// Section 4.1.2: a ball of 1000 kg rolls over planks of 1 kg. Eight starts; a run survives if no
// joint gap passes 0.1 m in 6 s. The motion is chaotic, so single runs differ and counts are what
// is tested.

#include <gtest/gtest.h>

#include "scenes/generator/scenes.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

constexpr double kSeconds = 6.0;
constexpr double kEnd = 4.9;  // the ball has left where its x is greater [m]

struct Crossing {
  Outcome run;
  double left_at = -1.0;  // [s], -1 if the ball did not leave
};

Crossing cross(const scenes::BridgeOptions& start, const Settings& settings,
               double seconds = kSeconds) {
  Crossing out;
  const Scene scene = scenes::bridge(start);
  const auto ball = static_cast<std::size_t>(*scene.criteria.track);
  out.run =
      run(scene, settings, seconds, [&](const Simulator& simulator, const FrameReport& report) {
        if (out.left_at < 0.0 && simulator.state().x[ball].x() > kEnd) out.left_at = report.time;
      });
  return out;
}

int survivors(const Settings& settings) {
  int count = 0;
  for (const auto& start : scenes::bridge_starts())
    count += cross(start, settings).run.holds ? 1 : 0;
  return count;
}

Settings with(SolverKind solver, Mode mode, int n = 16) {
  Settings settings;
  settings.solver = solver;
  settings.mode = mode;
  settings.n = n;
  return settings;
}

TEST(Bridge, WithoutStabilisationNoStartSurvivesHalfASecond) {
  for (const auto& start : scenes::bridge_starts()) {
    const Outcome r = cross(start, with(SolverKind::kBpp, Mode::kNone)).run;
    EXPECT_FALSE(r.holds);
    EXPECT_LT(r.failed_at, 0.45);
  }
}

TEST(Bridge, DampingAndCappedSurviveAllStarts) {
  EXPECT_EQ(survivors(with(SolverKind::kBpp, Mode::kDamping)), 8);
  EXPECT_EQ(survivors(with(SolverKind::kBpp, Mode::kCapped)), 8);
}

// At 8 the gaps come near the threshold (up to 0.09 m): start positions moved by a nanometre give 5
// to 8 survivors. At 6 it is over, at 10 there is room.
TEST(Bridge, ConstantStepsNeedAboutTen) {
  EXPECT_LE(survivors(with(SolverKind::kBpp, Mode::kConst, 6)), 3);
  EXPECT_GE(survivors(with(SolverKind::kBpp, Mode::kConst, 8)), 5);
  EXPECT_EQ(survivors(with(SolverKind::kBpp, Mode::kConst, 10)), 8);
}

TEST(Bridge, AdaptiveSurvivesAllStartsWithAThirdFewerSubsteps) {
  const Settings adaptive = with(SolverKind::kBpp, Mode::kAdaptive);
  std::int64_t substeps = 0;
  std::int64_t unsolved = 0;
  for (const auto& start : scenes::bridge_starts()) {
    const Crossing c = cross(start, adaptive);
    EXPECT_TRUE(c.run.holds) << c.run.verdict;
    EXPECT_LT(c.run.joint_gap, 0.02);
    EXPECT_GT(c.left_at, 1.8);
    EXPECT_LT(c.left_at, 2.6);
    substeps += c.run.substeps();
    unsolved += c.run.unsolved;
  }
  EXPECT_EQ(unsolved, 0) << "BPP never runs out of pivots";
  // 36 % fewer than const 16, over the eight starts (single runs: 20 to 50 %).
  const double fewer = 1.0 - static_cast<double>(substeps) / (8.0 * 16.0 * 60.0 * kSeconds);
  EXPECT_NEAR(fewer, 0.36, 0.05);
}

TEST(Bridge, TheBallLeavesAtTheSameTimeInEveryResolvedRun) {
  const scenes::BridgeOptions base;
  for (const Settings& settings :
       {with(SolverKind::kBpp, Mode::kAdaptive), with(SolverKind::kBpp, Mode::kConst, 16),
        with(SolverKind::kBpp, Mode::kConst, 32), with(SolverKind::kBpp, Mode::kCapped)}) {
    const Crossing c = cross(base, settings, 3.0);
    EXPECT_GE(c.left_at, 2.15);
    EXPECT_LE(c.left_at, 2.30);
  }
}

// Fig. 2, lower row. The prototype had 13 to 32 and 2 to 9.
TEST(Bridge, SubstepsRiseUnderTheBallAndFallOnceItHasLeft) {
  const Crossing c = cross(scenes::BridgeOptions{}, with(SolverKind::kBpp, Mode::kAdaptive), 10.0);
  constexpr std::size_t kWindow = 15;  // frames in 0.25 s
  const auto left = static_cast<std::size_t>(c.left_at * 60.0);
  for (std::size_t first = 0; first + kWindow <= c.run.n.size(); first += kWindow) {
    double mean = 0.0;
    for (std::size_t i = first; i < first + kWindow; ++i)
      mean += c.run.n[i] / static_cast<double>(kWindow);
    if (first + kWindow <= left) {
      EXPECT_GE(mean, 11.0) << first;
      EXPECT_LE(mean, 32.0) << first;
    } else if (first >= left + kWindow) {
      EXPECT_GE(mean, 2.0) << first;
      EXPECT_LE(mean, 10.0) << first;
    }
  }
}

TEST(BridgePgs, OnlySubstepsWithTheSoftDriftLawSurvive) {
  EXPECT_EQ(survivors(with(SolverKind::kPgs, Mode::kNone)), 0);
  EXPECT_EQ(survivors(with(SolverKind::kPgs, Mode::kDamping)), 0);
  EXPECT_EQ(survivors(with(SolverKind::kPgs, Mode::kAdaptive)), 8);
}

// The prototype lost all eight starts with the full law. Here they survive, but the law feeds
// energy in: after the ball has left the planks shake at the cap of 64 sub-steps where the soft law
// needs 5.
TEST(BridgePgs, TheFullDriftLawKeepsShakingAfterTheBallHasLeft) {
  Settings settings = with(SolverKind::kPgs, Mode::kAdaptive);
  std::int64_t soft = 0;
  std::int64_t full = 0;
  for (const auto& start : scenes::bridge_starts()) {
    settings.drift = Drift::kSoft;
    soft += cross(start, settings).run.substeps();
    settings.drift = Drift::kFull;
    full += cross(start, settings).run.substeps();
  }
  EXPECT_GT(full, 2 * soft);
}

}  // namespace
}  // namespace substep::test
