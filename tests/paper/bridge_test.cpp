// Section 4.1.2: a ball of 1000 kg rolls over planks of 1 kg. Eight starts; a run survives if no
// joint gap exceeds 0.1 m in 6 s. The motion is chaotic, so single runs differ and the tests check
// counts.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

constexpr double kSeconds = 6.0;
constexpr double kEnd = 4.9;  // the ball has left when its x exceeds this [m]

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

// At 8 the gaps approach the threshold (up to 0.09 m): start positions moved by a nanometre give 5
// to 8 survivors. At 6 the gaps exceed it, at 10 there is a margin.
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

// Fig. 2, lower row. In the prototype N was 13 to 32 and 2 to 9.
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

// The prototype lost all eight starts with the full law. Here they survive, but the law adds
// energy: after the ball has left, the planks shake at the cap of 64 sub-steps, whereas the soft
// law needs 5.
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

/// Energy in soft joints and contacts: C lambda^2/2 [J].
double stored(const Simulator& simulator) {
  const Scene& scene = simulator.scene();
  const ConstraintForces forces = simulator.constraint_forces();
  double sum = 0.0;
  for (std::size_t i = 0; i < forces.joints.size(); ++i) {
    sum += 0.5 * base(scene.joints[i]).compliance * forces.joints[i].force.squaredNorm();
  }
  for (const auto& contact : forces.contacts) {
    sum += 0.5 * scene.contact.compliance * contact.force.squaredNorm();
  }
  return sum;
}

struct Loss {
  double energy = 0.0;     // from the start until the ball has left [J]
  double exchanged = 0.0;  // range of the kinetic energy in that time [J]
};

/// @param moved offset of the ball's start along the bridge [m]
Loss loss(const scenes::BridgeOptions& start, const Settings& settings, double moved = 0.0) {
  Scene scene = scenes::bridge(start);
  const auto ball = static_cast<std::size_t>(*scene.criteria.track);
  scene.bodies[ball].position.x() += moved;
  Simulator simulator = simulator_of(scene, settings);
  FrameReport report = simulator.step();
  const double first = report.energy + stored(simulator);
  double least = report.kinetic;
  double most = report.kinetic;
  while (simulator.state().x[ball].x() < kEnd && report.time < 4.0) {
    report = simulator.step();
    least = std::min(least, report.kinetic);
    keep_largest(most, report.kinetic);
  }
  return {first - report.energy - stored(simulator), most - least};
}

Settings leapfrog(Settings settings) {
  settings.integrator = Integrator::kLeapfrog;
  return settings;
}

// The ball hops, and its next landing point depends on micrometres; in a sub-step of 256 per frame
// it moves 200 of them. For some starts even a finer run differs by more than one per cent of the
// exchanged energy. Rounding has no such effect: a start moved by a nanometre changes the loss by
// less than 0.1 %.
TEST(BridgeEnergy, SingleStartsDependOnMicrometres) {
  const Settings fine = leapfrog(with(SolverKind::kBpp, Mode::kConst, 256));
  const Settings finer = leapfrog(with(SolverKind::kBpp, Mode::kConst, 1024));
  const auto starts = scenes::bridge_starts();
  const auto share = [](const Loss& a, const Loss& b) {
    return 100.0 * std::abs(a.energy - b.energy) / b.exchanged;
  };
  double finest = 0.0;
  double micrometre = 0.0;
  for (const auto& start : starts) {
    const Loss own = loss(start, fine);
    keep_largest(finest, share(loss(start, finer), own));
    keep_largest(micrometre, share(loss(start, fine, 1e-6), own));
    EXPECT_LT(share(loss(start, fine, 1e-9), own), 0.1);
  }
  EXPECT_GT(finest, 1.0);
  EXPECT_GT(micrometre, 0.1);
}

// The energy that the ball loses on landing, relative to leapfrog with 128 sub-steps, as the mean
// over the starts and as a share of the exchanged energy.
TEST(BridgeEnergy, FewSubstepsLoseMoreEnergyWhereTheBallLands) {
  const auto up_to = [](Mode mode, int n_cap) {
    Settings settings = with(SolverKind::kBpp, mode);
    settings.n_cap = n_cap;
    return settings;
  };
  std::vector<Loss> fine;
  for (const auto& start : scenes::bridge_starts()) {
    fine.push_back(loss(start, leapfrog(with(SolverKind::kBpp, Mode::kConst, 128))));
  }
  struct Row {
    Settings settings;
    double more;  // expected [%]
    double within;
  };
  const Row rows[] = {{leapfrog(with(SolverKind::kBpp, Mode::kConst, 64)), 2.5, 2.0},
                      {leapfrog(with(SolverKind::kBpp, Mode::kConst, 16)), 8.5, 2.0},
                      {leapfrog(with(SolverKind::kBpp, Mode::kAdaptive)), 1.5, 2.0},
                      {with(SolverKind::kBpp, Mode::kAdaptive), 3.2, 2.0},
                      {leapfrog(up_to(Mode::kInertia, 8)), 11.0, 3.0},
                      {up_to(Mode::kBlend, 4), 15.0, 3.0},
                      {with(SolverKind::kNewton, Mode::kConst, 1), 27.5, 4.0},
                      {up_to(Mode::kCapped, 4), 29.0, 4.0},
                      {with(SolverKind::kBpp, Mode::kDamping), 68.0, 6.0}};
  for (const auto& [settings, more, within] : rows) {
    double mean = 0.0;
    double least = 1e9;
    double most = -1e9;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      const Loss own = loss(scenes::bridge_starts()[i], settings);
      const double share = 100.0 * (own.energy - fine[i].energy) / fine[i].exchanged;
      mean += share / static_cast<double>(fine.size());
      least = std::min(least, share);
      keep_largest(most, share);
    }
    EXPECT_NEAR(mean, more, within) << name_of(settings.mode);
    EXPECT_GT(most - least, 2.0) << "the starts differ too much to be compared singly";
  }
}

}  // namespace
}  // namespace substep::test
