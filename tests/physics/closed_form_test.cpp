// Small scenes against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/constraints/contact_stage.hpp"
#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

Settings constant(int n, Integrator integrator) {
  Settings settings;
  settings.mode = Mode::kConst;
  settings.n = n;
  settings.integrator = integrator;
  return settings;
}

/// Period of a pendulum of length l, released from rest: 2 pi sqrt(l/g) / agm(1, cos(angle/2)).
double pendulum_period(double length, double cos_angle) {
  double a = 1.0;
  double b = std::sqrt(0.5 * (1.0 + cos_angle));
  for (int i = 0; i < 8; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2.0 * std::numbers::pi * std::sqrt(length / kGravity) / a;
}

/// Mean time between downward crossings of x = 0, interpolated between frames. [s]
double measured_period(Integrator integrator, int n) {
  const Outcome r = run(scenes::pendulum(), constant(n, integrator), 20.0);
  std::vector<double> crossings;
  for (std::size_t i = 1; i < r.track.size(); ++i) {
    const double before = r.track[i - 1].x();
    const double after = r.track[i].x();
    if (before > 0.0 && after <= 0.0) {
      crossings.push_back((static_cast<double>(i - 1) + before / (before - after)) / 60.0);
    }
  }
  return (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
}

TEST(Pendulum, SwingsWithThePeriodOfTheEllipticIntegral) {
  // A rod of length 1 about its end: I/(m d) with d = 0.5, box inertia about the hinge's axis.
  const double inertia = (1.0 + 0.05 * 0.05) / 12.0 + 0.25;
  const double exact = pendulum_period(inertia / 0.5, 0.8);
  EXPECT_NEAR(exact, 1.682, 5e-4) << "the scene's own description";
  const double interpolation =
      1e-4;  // of a sine sampled at 60 Hz, averaged over eleven periods [s]
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
    EXPECT_NEAR(measured_period(integrator, 16), exact, interpolation);
  }
  // Second order in both: Euler is leapfrog with the start shifted by half a sub-step.
  const double coarse = std::abs(measured_period(Integrator::kLeapfrog, 1) - exact);
  EXPECT_LT(coarse, 2e-3);
}

TEST(FreeFall, LeapfrogIsExactAndEulerFallsHalfAStepAhead) {
  const double seconds = 2.0;
  const double exact = 20.0 - 0.5 * kGravity * seconds * seconds;
  for (const int n : {1, 4}) {
    const Outcome leapfrog = run(scenes::free_fall(), constant(n, Integrator::kLeapfrog), seconds);
    EXPECT_NEAR(leapfrog.track.back().y(), exact, 1e-12);
    EXPECT_NEAR(leapfrog.energy_end, leapfrog.energy_start, 1e-10);
    const Outcome euler = run(scenes::free_fall(), constant(n, Integrator::kEuler), seconds);
    const double ahead = 0.5 * kGravity * seconds / (60.0 * n);
    EXPECT_NEAR(euler.track.back().y(), exact - ahead, 1e-12);
  }
}

TEST(FreeFall, NeedsNoSubsteps) {
  const Outcome r = run(scenes::free_fall(), Settings{}, 1.0);
  EXPECT_EQ(r.n_max(), 1);
}

/// Highest points between bounces of a body of the bouncing balls, above its rest position [m].
std::vector<double> apexes(std::size_t body, const Settings& settings, double seconds) {
  std::vector<double> heights;
  double before = 2.0;
  double now = 2.0;
  run(scenes::bouncing_balls(), settings, seconds, [&](const Simulator& s, const FrameReport&) {
    const double next = s.state().x[body].y() - 0.2;
    if (now > before && now >= next) heights.push_back(now);
    before = now;
    now = next;
  });
  return heights;
}

// A lossless bounce reverses u at the same x: the upward steps retrace the downward ones.
TEST(Restitution, ALosslessBallReturnsToItsHeightForEver) {
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
    for (const int n : {1, 4}) {
      const auto heights = apexes(1, constant(n, integrator), 30.0);
      ASSERT_GT(heights.size(), 20U);
      // Sampled only at the ends of frames: with N = 4 the apex can be half a frame away from a
      // sample.
      const double unseen = n == 1 ? 1e-8 : 0.5 * kGravity / (120.0 * 120.0);
      for (const double height : heights) EXPECT_NEAR(height, heights.front(), unseen) << "n " << n;
      EXPECT_NEAR(heights.front(), 2.0, 0.5 * kGravity / (60.0 * 60.0) + unseen) << "n " << n;
    }
  }
}

TEST(Restitution, HeightsShrinkByItsSquare) {
  const double e[] = {1.0, 0.9, 0.7, 0.5};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto heights = apexes(i + 1, constant(64, Integrator::kLeapfrog), 4.0);
    ASSERT_GT(heights.size(), 1U);
    // The impact occurs within a sub-step of 0.26 ms, at up to 6.3 m/s.
    EXPECT_NEAR(heights[0], e[i] * e[i] * 2.0, 0.004);
    EXPECT_NEAR(heights[1] / heights[0], e[i] * e[i], 0.004);
  }
}

TEST(Restitution, SlowApproachesEndAtRest) {
  const Outcome r = run(scenes::bouncing_balls(), constant(4, Integrator::kEuler), 10.0);
  for (const std::size_t body : {std::size_t{4}, std::size_t{5}}) {
    EXPECT_NEAR(r.end.x[body].y(), 0.2, 1e-6);
    EXPECT_LT(r.end.u[body].norm(), 1e-9);
  }
}

/// The greatest heights of the first and the last ball of the cradle in every swing, above their
/// rest position [m].
struct Cradle {
  std::vector<double> first;
  std::vector<double> last;
  double middle = 0.0;         // the greatest speed of the others at those moments [m/s]
  double energy_change = 0.0;  // [J]
};

Cradle swing(const Settings& settings, double seconds) {
  Cradle cradle;
  Vec3 before = Vec3::Ones();
  Vec3 now = Vec3::Ones();  // heights of the first and the last
  const auto look = [&](const Simulator& s, const FrameReport&) {
    const Vec3 next(s.state().x[1].y() - 0.25, s.state().x[5].y() - 0.25, 0.0);
    for (const int i : {0, 1}) {
      if (!(now[i] > before[i] && now[i] >= next[i] && now[i] > 0.02)) continue;
      (i == 0 ? cradle.first : cradle.last).push_back(now[i]);
      for (const std::size_t body : {2U, 3U, 4U}) {
        keep_largest(cradle.middle, s.state().u[body].head<3>().norm());
      }
    }
    before = now;
    now = next;
  };
  const Outcome r = run(scenes::newtons_cradle(), settings, seconds, look);
  cradle.energy_change = r.energy_end - r.energy_start;
  return cradle;
}

// Equal bodies exchange their velocities: each impact passes the first ball's velocity to the last.
TEST(NewtonsCradle, OneBallInIsOneBallOut) {
  const Scene scene = scenes::newtons_cradle();
  struct Row {
    SolverKind solver;
    Forces forces;
    double loss;  // upper bound, of 1.96 J
  };
  // With twice the sub-steps the error of bpp is 2e-5. The residual of 25 sweeps remains in the
  // other balls. Implicit Euler (`xpbd` and forces at the end) damps the swing itself: by half as
  // much with twice the sub-steps, as below.
  for (const auto& [solver, forces, loss] :
       {Row{SolverKind::kBpp, Forces::kEnd, 2e-4}, Row{SolverKind::kPgs, Forces::kEnd, 0.1},
        Row{SolverKind::kXpbd, Forces::kEnd, 0.15}, Row{SolverKind::kNewton, Forces::kEnd, 0.15},
        Row{SolverKind::kNewton, Forces::kMean, 1e-3}}) {
    Settings settings = scene.settings;
    settings.solver = solver;
    settings.forces = forces;
    const Cradle cradle = swing(settings, 10.0);
    ASSERT_GE(cradle.last.size(), 4U) << name_of(solver);
    ASSERT_GE(cradle.first.size(), 4U) << name_of(solver);
    EXPECT_NEAR(cradle.last.front(), 0.2, 0.002) << name_of(solver);
    EXPECT_NEAR(cradle.first.front(), 0.2, 0.004) << name_of(solver);
    EXPECT_LT(cradle.middle, 0.2) << name_of(solver) << ", of 1.98 m/s";
    EXPECT_NEAR(cradle.energy_change, 0.0, loss) << name_of(solver);
  }
}

TEST(NewtonsCradle, ImplicitEulerDampsItsSwingAtFirstOrder) {
  Settings settings = scenes::newtons_cradle().settings;
  settings.solver = SolverKind::kNewton;
  settings.mode = Mode::kConst;
  settings.n = 64;
  const double coarse = swing(settings, 5.0).energy_change;
  settings.n = 128;
  const double fine = swing(settings, 5.0).energy_change;
  EXPECT_LT(coarse, 0.0);
  EXPECT_NEAR(coarse / fine, 2.0, 0.1);
}

// Impacts propagate within the sub-step, whatever its length.
TEST(NewtonsCradle, TheImpactPassesThroughTheRowInOneStepPerFrame) {
  const Cradle cradle = swing({.mode = Mode::kNone}, 2.0);
  ASSERT_FALSE(cradle.last.empty());
  EXPECT_NEAR(cradle.last.front(), 0.2, 0.02);
  EXPECT_NEAR(cradle.energy_change, 0.0, 0.02);
}

// Two balls head on: momentum is conserved, and they separate with e times their approach speed.
TEST(Restitution, SeparationIsETimesTheSpeedOfApproach) {
  for (const SolverKind solver :
       {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kXpbd, SolverKind::kNewton}) {
    for (const double e : {0.0, 0.3, 1.0}) {
      Scene scene = scenes::bouncing_balls();
      scene.effects.gravity = false;
      scene.bodies.resize(3);
      Body& a = scene.bodies[1];
      Body& b = scene.bodies[2];
      a.position = {0.0, 5.0, 0.0};
      b.position = {1.0, 5.0, 0.0};
      a.velocity = {2.0, 0.0, 0.0};
      b.velocity = {-1.0, 0.0, 0.0};
      a.restitution = 0.0;  // the larger restitution applies
      b.restitution = e;
      b.mass = 3.0;
      b.inertia = solid_inertia(b.shape, b.mass);
      Settings settings = constant(4, Integrator::kEuler);
      settings.solver = solver;
      const State end = run(scene, settings, 1.0).end;
      const double v_a = end.u[1][0];
      const double v_b = end.u[2][0];
      EXPECT_NEAR(v_b - v_a, 3.0 * e, 1e-9) << name_of(solver);
      EXPECT_NEAR(v_a + 3.0 * v_b, -1.0, 1e-12) << name_of(solver);
    }
  }
}

// u belongs to the middle of the last sub-step: angular momentum and energy are those of the
// momentum at its end, p = I w + dt/2 (I w) x w.
TEST(SpinningTop, KeepsEnergyAndAngularMomentumFor60SecondsAtOneSubstep) {
  const Scene scene = scenes::spinning_top();
  const Vec3 I = scene.bodies[0].inertia;
  const auto momentum = [&](const State& state) {
    const Vec3 w = state.q[0].conjugate() * Vec3(state.u[0].tail<3>());
    return Vec3(I.cwiseProduct(w) + 0.5 * state.dt_previous * I.cwiseProduct(w).cross(w));
  };
  const State start = initial_state(scene);
  const Vec3 L = start.q[0] * momentum(start);
  const double energy = 0.5 * momentum(start).dot(momentum(start).cwiseQuotient(I));
  double least = 1.0;
  const Outcome r = run(scene, constant(1, Integrator::kEuler), 60.0,
                        [&](const Simulator& simulator, const FrameReport& report) {
                          const State& state = simulator.state();
                          const Vec3 p = momentum(state);
                          EXPECT_LT((state.q[0] * p - L).norm(), 1e-10 * L.norm());
                          EXPECT_NEAR(0.5 * p.dot(p.cwiseQuotient(I)), energy, 1e-10 * energy);
                          EXPECT_NEAR(report.kinetic, energy, 1e-9 * energy);
                          least = std::min(least, (state.q[0] * Vec3::UnitY()).y());
                        });
  EXPECT_LT(least, -0.9) << "it tips over";
}

TEST(SpinningTop, TheExplicitTorqueGainsEnergy) {
  Settings settings = constant(1, Integrator::kEuler);
  settings.gyroscopic = Gyroscopic::kExplicit;
  const Outcome r = run(scenes::spinning_top(), settings, 10.0);
  EXPECT_GT(r.energy_end, 1.2 * r.energy_start);
}

/// Distance that the box slides down the slope in a given time, with friction mu. [m]
double slid(double mu, double seconds, SolverKind solver) {
  scenes::SlopeOptions slope;
  slope.friction = mu;
  Settings settings = constant(4, Integrator::kEuler);
  settings.solver = solver;
  settings.iterations = 200;
  const Outcome r = run(scenes::sliding_box(slope), settings, seconds);
  return (r.track.back() - r.track.front()).norm();
}

TEST(SlidingBox, SticksAboveTheTangentOfTheSlopeAndSlipsBelow) {
  const double tangent = 5.0 / 12.0;
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    EXPECT_LT(slid(1.001 * tangent, 2.0, solver), 1e-6);
    EXPECT_GT(slid(0.999 * tangent, 2.0, solver), 1e-3);
  }
}

TEST(SlidingBox, SlipsWithTheAccelerationOfCoulomb) {
  const double mu = 0.3;
  const double seconds = 1.5;
  const double acceleration = kGravity * (5.0 / 13.0 - mu * 12.0 / 13.0);
  // Euler is half a sub-step ahead, as in free fall.
  const double exact = 0.5 * acceleration * seconds * (seconds + 1.0 / 240.0);
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    EXPECT_NEAR(slid(mu, seconds, solver), exact, 1e-3 * exact);
  }
}

// At rest the normal row carries the weight: gap = -C lambda, exactly, for any step.
TEST(RestingBall, SinksByComplianceTimesWeight) {
  Scene scene;
  scene.effects = {.gravity = true, .contact = true};
  scene.contact.compliance = 1e-5;
  Body floor;
  floor.shape = Plane{};
  floor.is_static = true;
  Body ball;
  ball.shape = Sphere{0.5};
  ball.mass = 3.0;
  ball.inertia = solid_inertia(ball.shape, ball.mass);
  ball.position.y() = 0.5;
  scene.bodies = {floor, ball};
  scene.criteria.track = 1;
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    for (const int n : {1, 16}) {
      Settings settings = constant(n, Integrator::kEuler);
      settings.solver = solver;
      settings.drift = Drift::kFull;
      const Outcome r = run(scene, settings, 2.0);
      EXPECT_NEAR(r.track.back().y(), 0.5 - 1e-5 * 3.0 * kGravity, 1e-12);
    }
  }
}

TEST(RollingBall, RollsWithoutSlippingDownASlope) {
  scenes::SlopeOptions slope;
  slope.friction = 0.5;
  Scene scene = scenes::sliding_box(slope);
  scene.bodies[1].shape = Sphere{0.25};
  scene.bodies[1].inertia = solid_inertia(scene.bodies[1].shape, 1.0);
  const double seconds = 1.0;
  const Outcome r = run(scene, constant(16, Integrator::kLeapfrog), seconds);
  const double acceleration = kGravity * (5.0 / 13.0) / 1.4;  // I = 2/5 m r^2
  const double exact = 0.5 * acceleration * seconds * seconds;
  EXPECT_NEAR((r.track.back() - r.track.front()).norm(), exact, 1e-3 * exact);
  const double spin = r.end.u[1].tail<3>().norm() * 0.25;
  EXPECT_NEAR(spin, r.end.u[1].head<3>().norm(), 1e-6);
}

}  // namespace
}  // namespace substep::test
