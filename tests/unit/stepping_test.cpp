#include <cmath>

#include "core/math/gyroscopic.hpp"
#include "core/model/names.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/full_stiffness.hpp"
#include "core/stepping/held_stiffness.hpp"
#include "core/stepping/substep_clock.hpp"
#include "core/stepping/time_integrator.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

constexpr double kFrame = 1.0 / 60.0;

/// Sub-steps of one frame, with the same r after each. @param sum out, total of their lengths [s]
int deal(const Settings& settings, double r, double* sum = nullptr) {
  SubstepClock clock(settings, kFrame, r);
  int n = 0;
  double total = 0.0;
  while (clock.running()) {
    total += clock.dt();
    ++n;
    clock.advance(r);
  }
  if (sum != nullptr) *sum = total;
  return n;
}

/// Every mode with each policy, 200 times with another N. @param run(settings, random)
template <class Run>
void for_many_clocks(const Run& run) {
  Random random(1);
  for (const Mode mode : {Mode::kNone, Mode::kConst, Mode::kDamping, Mode::kAdaptive, Mode::kCapped,
                          Mode::kStiffness, Mode::kInertia, Mode::kBlend}) {
    for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
      for (int trial = 0; trial < 200; ++trial) {
        Settings settings;
        settings.mode = mode;
        settings.policy = policy;
        settings.n = 1 + trial;
        run(settings, random);
      }
    }
  }
}

TEST(SubstepClock, FillsTheWholeFrame) {
  for_many_clocks([](const Settings& settings, Random& random) {
    SubstepClock clock(settings, kFrame, uniform(random, 0.0, 1e6));
    double sum = 0.0;
    while (clock.running()) {
      EXPECT_GT(clock.dt(), 0.0);
      sum += clock.dt();
      clock.advance(uniform(random, 0.0, 1e6));
    }
    EXPECT_NEAR(sum, kFrame, 1e-15);
  });
}

// Impacts end sub-steps early, a limited number of times in a frame.
TEST(SubstepClock, FillsTheWholeFrameWhereImpactsEndSubsteps) {
  for_many_clocks([](const Settings& settings, Random& random) {
    SubstepClock clock(settings, kFrame, uniform(random, 0.0, 1e6));
    double sum = 0.0;
    int shortened = 0;
    while (clock.running()) {
      const double whole = clock.dt();
      EXPECT_LE(whole, (1.0 + 1e-12) * clock.planned_dt());
      if (uniform(random, 0.0, 1.0) < 0.5 && clock.may_shorten(4)) {
        clock.shorten(uniform(random, 0.001, 0.999) * whole);
        clock.shorten(uniform(random, 0.001, 0.999) * whole);  // corrected
        ++shortened;
      }
      EXPECT_GT(clock.dt(), 0.0);
      EXPECT_LE(clock.dt(), whole);
      sum += clock.dt();
      clock.advance(uniform(random, 0.0, 1e6));
    }
    EXPECT_NEAR(sum, kFrame, 1e-14);
    if (settings.policy == Policy::kFrame) {  // else the plan changes
      EXPECT_LE(shortened, std::max(4, (clock.taken() - shortened) / 4));
    }
  });
}

TEST(SubstepClock, TakesTheCeilingOfEq11) {
  Settings settings;
  settings.n_max = 1000;
  for (const double r : {0.0, 1.0, 1e3, 1.4e5, 6e5, 1e7}) {
    const int expected =
        r == 0.0 ? 1 : static_cast<int>(std::ceil(kFrame / (2.0 * std::sqrt(0.1 / r))));
    for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
      settings.policy = policy;
      EXPECT_EQ(deal(settings, r), expected) << r;
    }
  }
}

TEST(SubstepClock, NeverExceedsTheCap) {
  for (const Mode mode : {Mode::kAdaptive, Mode::kCapped, Mode::kInertia, Mode::kBlend}) {
    for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
      for (int limit = 1; limit <= 512; ++limit) {
        Settings settings;
        settings.mode = mode;
        settings.policy = policy;
        (mode == Mode::kAdaptive ? settings.n_max : settings.n_cap) = limit;
        double sum = 0.0;
        ASSERT_EQ(deal(settings, 1e30, &sum), limit);
        ASSERT_NEAR(sum, kFrame, 1e-14);
      }
    }
  }
}

TEST(SubstepClock, PerSubstepTheMemoryDecays) {
  Settings settings;
  settings.policy = Policy::kSubstep;
  settings.memory = 0.5;
  SubstepClock clock(settings, kFrame, 1e6);
  const double first = clock.dt();
  clock.advance(0.0);
  EXPECT_DOUBLE_EQ(clock.r(), 5e5);
  EXPECT_GT(clock.dt(), first);
  clock.advance(8e5);
  EXPECT_DOUBLE_EQ(clock.r(), 8e5);
}

TEST(SubstepClock, HoldsTheLeastStiffnessThroughTheFrame) {
  Settings settings;
  settings.policy = Policy::kSubstep;
  settings.memory = 0.0;
  const double r = 4.0 * settings.alpha * 100.0 / (kFrame * kFrame);  // needs 10 sub-steps
  SubstepClock clock(settings, kFrame, 0.0, 0.0, r);
  int taken = 0;
  for (; clock.running(); clock.advance(0.0)) ++taken;
  EXPECT_EQ(taken, 10);
}

TEST(SubstepClock, ReportsASubstepThatWasTooLong) {
  Settings settings;
  settings.redo = true;
  const double r = 4.0 * settings.alpha * 100.0 / (kFrame * kFrame);  // needs 10 sub-steps
  const auto exceeded = [&](double at_start, double on_the_way) {
    SubstepClock clock(settings, kFrame, at_start);
    while (clock.running()) clock.advance(clock.taken() == 0 ? on_the_way : 0.0);
    return clock.exceeded();
  };
  EXPECT_TRUE(exceeded(0.9 * 0.81 * r, r));
  EXPECT_FALSE(exceeded(r, r));
  settings.n_max = 5;  // more are not possible
  EXPECT_FALSE(exceeded(r, 2.0 * r));
  settings.n_max = 64;
  settings.redo = false;
  EXPECT_FALSE(exceeded(0.5 * r, r));
}

TEST(HeldStiffness, RisesAtOnceAndFallsAfterOneToTwoWindows) {
  Settings settings;
  settings.hold = 5;
  State state;
  const int body = 0;
  const auto after = [&](double r) {
    hold_stiffness(settings, std::span(&r, 1), state);
    return held_stiffness(state, std::span(&body, 1));
  };
  EXPECT_EQ(after(3.0), 3.0);
  EXPECT_EQ(after(7.0), 7.0);
  int frames = 0;
  while (frames < 100 && after(2.0) == 7.0) ++frames;
  EXPECT_GE(frames, 5);
  EXPECT_LE(frames, 10);
  EXPECT_EQ(held_stiffness(state, std::span(&body, 1)), 2.0);
  EXPECT_EQ(after(9.0), 9.0);
  settings.hold = 1;
  EXPECT_EQ(after(1.0), 0.0);  // nothing is held
}

/// One body with a stiffness, as input of effective_mass().
struct StiffBody {
  StiffBody(const Settings& chosen, const Vec3& k_angular) : settings(chosen) {
    scene.bodies = {moving(Box{Vec3{0.3, 0.2, 0.5}}, 2.0)};
    scene.bodies[0].orientation = Quat(0.5, 0.5, 0.5, 0.5);
    state = initial_state(scene);
    Vec6 k;
    k << 1e9, 1e9, 1e9, k_angular;  // the translational part is left to the solver
    state.k = {k};
    R = rotations(state);
    // A restoring torque about the principal axes.
    const Mat3 K = -R[0] * k_angular.asDiagonal() * R[0].transpose();
    if (settings.mode == Mode::kStiffness) state.K_resisting = {resisting(K)};
  }
  [[nodiscard]] const Vec3& I() const { return scene.bodies[0].inertia; }

  Settings settings;
  Scene scene;
  State state;
  std::vector<Mat3> R;
  std::vector<InverseMass> inverse = std::vector<InverseMass>(1);
};

TEST(Damping, IsEq6OnTheAngularDegreesOfFreedomOnly) {
  Settings settings;
  settings.mode = Mode::kDamping;
  const double dt = 0.01;
  StiffBody body(settings, {1e5, 2e5, 0.0});  // the last is below the threshold
  body.state.u[0] << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  const std::vector<Vec6> before{Vec6::Constant(7.0)};  // damping does not keep it
  const Vec3 omega_B = body.R[0].transpose() * Vec3(4.0, 5.0, 6.0);
  effective_mass(body.scene, whole(body.scene), settings, inertia_inverses(body.scene), body.R,
                 before, dt, body.state, body.inverse);
  EXPECT_DOUBLE_EQ(body.inverse[0].linear, 0.5);
  EXPECT_EQ(Vec3(body.state.u[0].head<3>()), Vec3(1.0, 2.0, 3.0));
  const Mat3 local = body.R[0].transpose() * body.inverse[0].angular * body.R[0];
  const Vec3 turned = body.R[0].transpose() * Vec3(body.state.u[0].tail<3>());
  for (int i = 0; i < 3; ++i) {
    const double k = body.state.k[0][3 + i];
    const double I = body.I()[i];
    const double b = std::max(0.0, (dt * dt * k - 4.0 * settings.alpha * I) / dt);
    EXPECT_NEAR(local(i, i), 1.0 / (I + dt * b), 1e-12);
    EXPECT_NEAR(turned[i], omega_B[i] * I / (I + dt * b), 1e-12);
  }
}

/// An oscillator of one body about a principal axis: torque -growth k angle, while the mode uses k.
/// @return the ratio of the largest |angle| in the last tenth of the steps to that in the first
double growth_of_swing(const Settings& settings, double kappa, double growth) {
  constexpr double kDt = 0.01;
  constexpr int kSteps = 4000;
  const double I = StiffBody(settings, Vec3::Zero()).I()[1];
  const double k = kappa * I / (kDt * kDt);
  StiffBody body(settings, {0.0, k, 0.0});
  const Vec3 axis = body.R[0].col(1);
  const auto integrator = make_integrator(body.scene, nullptr, settings);
  double angle = 1.0;
  double dt_previous = 0.0;
  double first = 0.0;
  double last = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<Vec6> u_start = body.state.u;
    inverse_mass(inertia_inverses(body.scene), whole(body.scene), body.R, body.inverse);
    const double time = integrator->force_time(dt_previous, kDt);
    body.state.u[0].tail<3>() -= axis * (time * growth * k * angle / I);
    if (changes_mass(settings.mode)) {
      effective_mass(body.scene, whole(body.scene), settings, inertia_inverses(body.scene), body.R,
                     u_start, kDt, body.state, body.inverse);
    }
    angle += kDt * axis.dot(body.state.u[0].tail<3>());
    dt_previous = kDt;
    if (!(std::abs(angle) < 1e30)) return 1e30;
    if (step < kSteps / 10) keep_largest(first, std::abs(angle));
    if (step >= kSteps - kSteps / 10) keep_largest(last, std::abs(angle));
  }
  return last / first;
}

/// The factor by which the force may exceed the mode's k before the swing grows.
double largest_growth(const Settings& settings, double kappa) {
  double holds = 0.0;
  double fails = 1e4;
  while (fails - holds > 1e-4 * fails) {
    const double middle = 0.5 * (holds + fails);
    (growth_of_swing(settings, kappa, middle) < 2.0 ? holds : fails) = middle;
  }
  return holds;
}

// The model of Eq. 5 and the derivations in damping.cpp and geometric_inertia.cpp: predicted and
// measured limits.
TEST(Oscillator, StabilityLimitsMatchTheDerivation) {
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
    for (const double kappa : {0.5, 5.0, 300.0}) {  // dt^2 k/M; without a mode 4 is the limit
      const auto expect = [&](Mode mode, double Mt, double kept) {
        Settings settings;
        settings.mode = mode;
        settings.integrator = integrator;
        settings.alpha = 0.4;
        settings.beta = 0.9;
        const double predicted = 2.0 * (1.0 + kept) * Mt / kappa;
        EXPECT_NEAR(largest_growth(settings, kappa) / predicted, 1.0, 2e-3)
            << name_of(mode) << " kappa " << kappa;
        EXPECT_TRUE(!changes_mass(mode) || kappa < 1.0 || predicted > 1.0);
      };
      const Settings defaults;
      for (const Mode mode : {Mode::kNone, Mode::kConst, Mode::kAdaptive}) expect(mode, 1.0, 1.0);
      const double damped = damped_mass({.alpha = 0.4}, 1.0, kappa, 1.0);
      for (const Mode mode : {Mode::kDamping, Mode::kCapped}) expect(mode, damped, 1.0 / damped);
      expect(Mode::kStiffness, 1.0 + kappa, 1.0 / (1.0 + kappa));
      const double stiffened = stiffened_mass(defaults, 1.0, kappa, 1.0);
      expect(Mode::kInertia, stiffened, 1.0);
      expect(Mode::kBlend, stiffened, 0.9 + 0.1 / stiffened);
    }
  }
}

// Eqs. 10 and 11: the clock's step leaves a margin for a force 1/alpha times as large, none at
// alpha 1. Beyond its cap the damped mass covers the rest.
TEST(Oscillator, TheStepOfTheClockLeavesTheMarginOfAlpha) {
  constexpr double kRate = 1e8;  // r = k/M [1/s^2], of hundreds of sub-steps
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
    for (const double alpha : {0.1, 0.5, 1.0}) {
      Settings settings;
      settings.integrator = integrator;
      settings.alpha = alpha;
      settings.n_max = 10000;
      settings.n_cap = 8;
      settings.mode = Mode::kAdaptive;
      double dt = SubstepClock(settings, kFrame, kRate).dt();
      const double room = largest_growth(settings, dt * dt * kRate);
      EXPECT_NEAR(alpha * room, 1.0, 0.02) << alpha;
      EXPECT_GT(alpha * room, 0.998) << "N is rounded up";

      settings.mode = Mode::kCapped;
      dt = SubstepClock(settings, kFrame, kRate).dt();
      EXPECT_DOUBLE_EQ(dt, kFrame / 8.0);
      const double kappa = dt * dt * kRate;
      const double damped = damped_mass(settings, 1.0, kappa, 1.0);
      EXPECT_NEAR(largest_growth(settings, kappa) * kappa / (2.0 * (damped + 1.0)), 1.0, 2e-3);
      EXPECT_GT(largest_growth(settings, kappa), 1.0);
    }
  }
}

TEST(FullStiffness, KeepsWhatResistsARotation) {
  Random random(8);
  for (int trial = 0; trial < 200; ++trial) {
    Mat3 K;
    for (int i = 0; i < 9; ++i) K(i % 3, i / 3) = uniform(random);
    const Mat3 P = resisting(K);
    EXPECT_LT((P - P.transpose()).norm(), 1e-14);
    // P >= 0, P + K_sym >= 0, and P is minimal: P (P + K_sym) = 0.
    const Mat3 S = 0.5 * (K + K.transpose());
    for (int probe = 0; probe < 20; ++probe) {
      const Vec3 x = random_vector(random);
      EXPECT_GE(x.dot(P * x), -1e-14);
      EXPECT_GE(x.dot((P + S) * x), -1e-14);
    }
    EXPECT_LT((P * (P + S)).norm(), 1e-13);
  }
}

TEST(Drift, FullAndSoftLawsAndOpenContacts) {
  std::vector<Block> blocks(2);
  blocks[0].kind = kind_of(BallJoint{});
  blocks[0].rows = 1;
  blocks[0].phi[0] = 0.003;
  blocks[1].kind = BlockKind::kContact;
  blocks[1].rows = 1;
  const double tau = 1.0 / 480.0;
  const double dt = 1.0 / 960.0;
  const auto bias = [&](Drift law, double step, double gap) {
    blocks[1].phi[0] = gap;
    set_drift_bias(blocks, law, tau, step, step);
    return std::pair(blocks[0].bias[0], blocks[1].bias[0]);
  };
  EXPECT_DOUBLE_EQ(bias(Drift::kFull, dt, -0.001).first, 0.003 / dt);
  EXPECT_DOUBLE_EQ(bias(Drift::kSoft, dt, -0.001).first, 0.003 * dt / (tau * tau));
  EXPECT_DOUBLE_EQ(bias(Drift::kSoft, dt, -0.001).second, -0.001 * dt / (tau * tau));
  EXPECT_DOUBLE_EQ(bias(Drift::kSoft, dt, 0.001).second, 0.001 / dt)
      << "a body must not stop early";
  EXPECT_DOUBLE_EQ(bias(Drift::kSoft, 2.0 * tau, -0.001).first, 0.003 / (2.0 * tau));
  set_probe_bias(blocks, dt);
  EXPECT_EQ(blocks[0].bias[0], 0.0);
}

TEST(Gyroscopic, TheTwoHalvesConserveMomentumAndEnergyAtThePoses) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 I{uniform(random, 1.0, 3.0), uniform(random, 1.0, 3.0), uniform(random, 1.0, 3.0)};
    const auto at_pose = [&](const Vec3& w, double dt) {
      return Vec3(I.cwiseProduct(w) + 0.5 * dt * I.cwiseProduct(w).cross(w));
    };
    Vec3 w = 10.0 * random_vector(random);
    double before = 0.0;
    const Vec3 p0 = at_pose(w, 0.0);
    Vec3 p = p0;
    for (int step = 0; step < 50; ++step) {
      const double dt = uniform(random, 0.001, 0.03);
      w = velocity_of_momentum(I, momentum_after(I, w, before), dt, w);
      before = dt;
      p = at_pose(w, dt);
    }
    EXPECT_NEAR(p.norm(), p0.norm(), 1e-11 * p0.norm());
    EXPECT_NEAR(p.dot(p.cwiseQuotient(I)), p0.dot(p0.cwiseQuotient(I)), 1e-10 * p0.squaredNorm());
  }
}

}  // namespace
}  // namespace substep::test
