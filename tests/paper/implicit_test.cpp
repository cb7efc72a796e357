// Solvers that are implicit at the end of a sub-step: non-smooth Newton with forces at its end,
// with the mean of the poses around it and with Numerov's weights, and extended position-based
// dynamics.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/lab/planar_chain.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/paper/exact_swing.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

Settings newton(Forces forces, int n, int steps = 25) {
  Settings settings;
  settings.solver = SolverKind::kNewton;
  settings.forces = forces;
  settings.iterations = steps;
  settings.mode = Mode::kConst;
  settings.n = n;
  settings.integrator = Integrator::kLeapfrog;
  return settings;
}

// One step per frame is seven times the stable step of an explicit sub-step: BPP fails at once.
TEST(NewtonAtTheEnd, StandsAtOneSubstepAndDamps) {
  double before = -100.0;
  for (const int n : {1, 2, 4, 8}) {
    const Outcome r = swing(newton(Forces::kEnd, n));
    EXPECT_TRUE(r.holds) << r.verdict;
    EXPECT_EQ(r.unsolved, 0);
    EXPECT_LT(energy_drift_percent(r), -2.0) << n;
    EXPECT_GT(energy_drift_percent(r), 0.6 * before) << "first order: half with every doubling";
    before = energy_drift_percent(r);
  }
}

TEST(NewtonAtTheEnd, CrossesTheBridgeFromEveryStartAtOneSubstep) {
  for (const scenes::BridgeOptions& options : scenes::bridge_starts()) {
    const Outcome r = run(scenes::bridge(options), newton(Forces::kEnd, 1), 6.0);
    EXPECT_TRUE(r.holds) << r.verdict;
    EXPECT_LT(r.joint_gap, 1e-3);
  }
}

// 600 sub-steps of two solves each: geometric inertia with as many has ten times the error, the
// paper's 9,476 sub-steps fifteen times.
TEST(NewtonAtTheMean, IsMoreExactThanGeometricInertia) {
  const std::pair<int, double> most[] = {{1, 9e-4}, {2, 2.4e-4}, {4, 7.5e-5}};  // [m]
  for (const auto& [n, error] : most) {
    const Outcome r = swing(newton(Forces::kMean, n, 2));
    EXPECT_TRUE(r.holds) << r.verdict;
    EXPECT_LE(tip_error(r), error) << n;
    EXPECT_GT(tip_error(r), 0.5 * error) << n;
  }
}

TEST(NewtonAtTheMean, TakesOneSolveFromTwoSubstepsOn) {
  const Outcome millimetre = swing(newton(Forces::kMean, 2, 1));
  EXPECT_TRUE(millimetre.holds) << millimetre.verdict;
  EXPECT_LT(tip_error(millimetre), 2.5e-4);
  const Outcome hundredth = swing(newton(Forces::kMean, 11, 1));
  EXPECT_TRUE(hundredth.holds) << hundredth.verdict;
  EXPECT_LT(tip_error(hundredth), 1e-5);
}

/// Runs 60 frames, reverses the last velocity and runs back. @return the distance from the start
/// [m]
double off_after_return(const Settings& settings) {
  constexpr int kThere = 60;
  const auto scene = std::make_shared<const Scene>(scenes::rope_of_n({5, 0.4, 10.0, 0.0}));
  Simulator simulator = simulator_of(scene, settings);
  const State start = simulator.state();
  for (int i = 0; i < kThere; ++i) simulator.step();
  State back = simulator.state();  // its poses, and the velocity of the next sub-step
  simulator.step();
  for (std::size_t i = 0; i < back.u.size(); ++i) back.u[i] = -simulator.state().u[i];
  simulator.set_state(back);
  for (int i = 0; i < kThere; ++i) simulator.step();
  double off = 0.0;
  for (std::size_t i = 0; i < start.x.size(); ++i) {
    keep_largest(off, (simulator.state().x[i] - start.x[i]).norm());
  }
  return off;
}

TEST(NewtonAtTheMean, IsReversibleInTime) {
  EXPECT_LT(off_after_return(newton(Forces::kMean, 1)), 1e-5);
  EXPECT_GT(off_after_return(newton(Forces::kEnd, 1)), 1e-2);
}

TEST(NewtonAtTheMean, KeepsEnergyFor200Seconds) {
  for (const int steps : {2, 25}) {
    const Outcome r = swing(newton(Forces::kMean, 1, steps), 200.0);
    EXPECT_TRUE(r.holds) << r.verdict;
    EXPECT_NEAR(energy_drift_percent(r), 0.0, 0.05) << steps;
  }
}

/// A rod that hangs under such gravity that dt^2 k/M = kappa, displaced by a thousandth of a
/// radian: the ratio of its largest swing in the last tenth of 400 sub-steps to that in the first
/// `first_steps`.
double growth_of_rod(Forces forces, double kappa, int steps = 100, int first_steps = 40) {
  Scene scene = scenes::pendulum();
  Body& rod = scene.bodies[0];
  const auto& hinge = std::get<HingeJoint>(scene.joints[0]);
  const double arm = hinge.anchor_a.norm();
  const double inertia = rod.inertia.z() + rod.mass * arm * arm;  // about the hinge
  const double dt = scene.frame;
  scene.effects.gravity = false;  // the gravity exceeds the allowed range
  scene.effects.external = true;
  rod.force = {0.0, -kappa * inertia / (dt * dt * arm), 0.0};
  rod.orientation = Quat(Eigen::AngleAxisd(1e-3 - 0.5 * std::numbers::pi, Vec3::UnitZ()));
  rod.position = hinge.anchor_b - rod.orientation * hinge.anchor_a;
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.set_settings(newton(forces, 1, steps));
  constexpr int kSteps = 400;
  double first = 0.0;
  double last = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    if (simulator.step().status != StepStatus::kOk) return 1e9;
    const double aside = std::abs(simulator.state().x[0].x());
    if (i < first_steps) keep_largest(first, aside);
    if (i >= kSteps - kSteps / 10) keep_largest(last, aside);
  }
  return last / first;
}

// The derivations in newton.cpp, on one body: predicted limits against measured ones.
TEST(NewtonOnOneBody, IsStableUpToTheDerivedLimit) {
  for (const double kappa : {0.5, 5.9, 50.0, 500.0}) {
    EXPECT_NEAR(growth_of_rod(Forces::kMean, kappa), 1.0, 0.05) << kappa;
    EXPECT_LT(growth_of_rod(Forces::kEnd, kappa), 0.01) << kappa;
  }
  EXPECT_NEAR(growth_of_rod(Forces::kNumerov, 5.9), 1.0, 0.1);
  EXPECT_GT(growth_of_rod(Forces::kNumerov, 6.1, 100, 1), 10.0);  // full swings within 40
  // Two steps are as good as convergence, and one holds almost as far.
  EXPECT_NEAR(growth_of_rod(Forces::kNumerov, 5.8, 2), 1.0, 0.01);
  EXPECT_NEAR(growth_of_rod(Forces::kNumerov, 3.0, 1), 1.0, 0.005);
  EXPECT_NEAR(growth_of_rod(Forces::kNumerov, 5.4, 1), 1.0, 0.05);
  EXPECT_GT(growth_of_rod(Forces::kNumerov, 6.1, 1, 1), 10.0);
}

/// Largest distance of any body of a bending chain of three from the exact motion [m].
double chain_error(Forces forces, int n, int steps = 25) {
  const Scene scene = scenes::rope_of_n({2, 0.4, 1.0, 0.0});
  auto exact = PlanarChain::of(scene);
  double worst = 0.0;
  run(scene, newton(forces, n, steps), 1.0, [&](const Simulator& simulator, const FrameReport&) {
    exact->advance(scene.frame);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Vec3 off = exact->centre(static_cast<int>(i)) - simulator.state().x[i];
      keep_largest(worst, off.norm());
    }
  });
  return worst;
}

TEST(NewtonAtTheMean, IsOfSecondOrder) {
  EXPECT_NEAR(std::log2(chain_error(Forces::kMean, 8) / chain_error(Forces::kMean, 16)), 2.0, 0.05);
}

// Even with a single step, i.e. one linear solve per sub-step.
TEST(Numerov, IsOfFourthOrder) {
  for (const auto& [steps, order] : {std::pair{1, 4.0}, std::pair{2, 4.0}, std::pair{25, 4.0}}) {
    const double error = chain_error(Forces::kNumerov, 8, steps);
    EXPECT_NEAR(std::log2(error / chain_error(Forces::kNumerov, 16, steps)), order, 0.3) << steps;
    EXPECT_LT(error, chain_error(Forces::kMean, 8) / 50.0) << steps;
  }
}

// Exact joints without compliance; leapfrog with BPP at as many sub-steps and solves leaves a tenth
// of a millimetre.
TEST(Numerov, FollowsTheSwingingBoxToAMicrometreWithOneSolveASubstep) {
  const Outcome r = swing(newton(Forces::kNumerov, 8, 1), 10.0, 0.0);
  EXPECT_TRUE(r.holds) << r.verdict;
  EXPECT_LT(tip_error(r), 1e-6);
}

// The weight of a neighbour is 1/12: stable while dt^2 k < 6 M, i.e. from N = 6 on here.
TEST(Numerov, IsStableUpToTheDerivedLimit) {
  EXPECT_TRUE(swing(newton(Forces::kNumerov, 6)).holds);
  EXPECT_FALSE(swing(newton(Forces::kNumerov, 4)).holds);
}

// Without iteration the method is explicit: a single solve per sub-step holds from N = 8 on, and
// with 6 it fails after a minute and a half.
TEST(Numerov, KeepsEnergyFor200Seconds) {
  for (const auto& [n, steps] : {std::pair{6, 2}, std::pair{8, 1}}) {
    const Outcome r = swing(newton(Forces::kNumerov, n, steps), 200.0);
    EXPECT_TRUE(r.holds) << r.verdict;
    EXPECT_NEAR(energy_drift_percent(r), 0.0, 0.001) << n;
  }
  EXPECT_FALSE(swing(newton(Forces::kNumerov, 6, 1), 200.0).holds);
}

Settings xpbd(int n, int sweeps) {
  Settings settings;
  settings.solver = SolverKind::kXpbd;
  settings.mode = Mode::kConst;
  settings.n = n;
  settings.iterations = sweeps;
  return settings;
}

// Macklin et al. 2019, "Small steps in physics simulation": sub-steps are a better use of sweeps
// than iterations.
TEST(Xpbd, SubstepsBeatSweeps) {
  const Scene scene = scenes::rope_of_n({10, 0.4, 1.0});
  const Outcome sweeps = run(scene, xpbd(1, 16), 2.0, {}, false);
  const Outcome substeps = run(scene, xpbd(16, 1), 2.0, {}, false);
  EXPECT_LT(substeps.joint_gap, 0.3 * sweeps.joint_gap);
}

// Its first claim: a compliant joint stretches by C F, for any step and number of sweeps.
TEST(Xpbd, StretchesByTheCompliance) {
  Scene scene = scenes::rope_of_n({1, 0.4, 1.0, 1e-4, {0.0, 1.0}});  // hangs straight down
  for (Body& body : scene.bodies) body.velocity.setZero();
  for (const auto& [n, sweeps] : {std::pair{4, 40}, std::pair{16, 40}, std::pair{16, 200}}) {
    double mean = 0.0;
    int frames = 0;
    run(scene, xpbd(n, sweeps), 10.0, [&](const Simulator& simulator, const FrameReport& report) {
      if (report.time < 5.0) return;  // implicit in time: the bounce has decayed
      mean += simulator.state().x[0].y();
      ++frames;
    });
    const double stretch = -0.2 - mean / frames;
    EXPECT_NEAR(stretch, 1e-4 * 2.0 * 9.81, 2e-5) << n << " x " << sweeps;
  }
}

// At a mass ratio of a thousand to one, one sweep per sub-step lets the links swing wildly between
// their joints; 25 hold from N = 4 on, but stretch.
TEST(Xpbd, NeedsManySweepsForTheHeavyBox) {
  EXPECT_FALSE(swing(xpbd(28, 1)).holds);
  EXPECT_FALSE(swing(xpbd(1, 25)).holds);
  EXPECT_TRUE(swing(xpbd(16, 25)).holds);
}

}  // namespace
}  // namespace substep::test
