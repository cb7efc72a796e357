#include <cmath>

#include "core/stepping/drift.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/gyroscopic.hpp"
#include "core/stepping/substep_clock.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

constexpr double kFrame = 1.0 / 60.0;

/// Sub-steps of one frame, with the same r after each. @param sum out, of their lengths [s]
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

TEST(SubstepClock, DealsOutTheWholeFrame) {
  Random random(1);
  for (const Mode mode :
       {Mode::kNone, Mode::kConst, Mode::kDamping, Mode::kAdaptive, Mode::kCapped}) {
    for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
      for (int trial = 0; trial < 200; ++trial) {
        Settings settings;
        settings.mode = mode;
        settings.policy = policy;
        settings.n = 1 + trial;
        SubstepClock clock(settings, kFrame, uniform(random, 0.0, 1e6));
        double sum = 0.0;
        while (clock.running()) {
          EXPECT_GT(clock.dt(), 0.0);
          sum += clock.dt();
          clock.advance(uniform(random, 0.0, 1e6));
        }
        EXPECT_NEAR(sum, kFrame, 1e-15);
      }
    }
  }
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

TEST(SubstepClock, NeverPassesTheCapWhateverItIs) {
  for (const Mode mode : {Mode::kAdaptive, Mode::kCapped}) {
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

TEST(SubstepClock, PerSubstepTheMemoryFades) {
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

TEST(Damping, IsEq6OnTheAngularDegreesOfFreedomOnly) {
  Scene scene;
  scene.bodies = {moving(Box{Vec3{0.3, 0.2, 0.5}}, 2.0)};
  scene.bodies[0].orientation = Quat(0.5, 0.5, 0.5, 0.5);
  const State state = initial_state(scene);
  const Vec3 I = scene.bodies[0].inertia;
  const double alpha = 0.1;
  const double dt = 0.01;
  Vec6 k;
  k << 1e9, 1e9, 1e9, 1e5, 2e5, 0.0;  // the last is below the threshold
  std::vector<Vec6> ks{k};
  std::vector<Vec6> u(1);
  u[0] << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  const Vec3 omega_B = scene.bodies[0].orientation.conjugate() * Vec3(4.0, 5.0, 6.0);
  std::vector<InverseMass> inverse;
  damped_inverse_mass(scene, rotations(state), ks, alpha, dt, inverse, u);
  EXPECT_DOUBLE_EQ(inverse[0].linear, 0.5);
  EXPECT_EQ(Vec3(u[0].head<3>()), Vec3(1.0, 2.0, 3.0));
  const Mat3 R = state.q[0].toRotationMatrix();
  const Mat3 local = R.transpose() * inverse[0].angular * R;
  const Vec3 turned = R.transpose() * Vec3(u[0].tail<3>());
  for (int i = 0; i < 3; ++i) {
    const double b = std::max(0.0, (dt * dt * k[3 + i] - 4.0 * alpha * I[i]) / dt);
    EXPECT_NEAR(local(i, i), 1.0 / (I[i] + dt * b), 1e-12);
    EXPECT_NEAR(turned[i], omega_B[i] * I[i] / (I[i] + dt * b), 1e-12);
  }
}

TEST(Drift, FullAndSoftLawsAndOpenContacts) {
  std::vector<Block> blocks(2);
  blocks[0].kind = BlockKind::kBall;
  blocks[0].rows = 1;
  blocks[0].phi[0] = 0.003;
  blocks[1].kind = BlockKind::kContact;
  blocks[1].rows = 1;
  const double tau = 1.0 / 480.0;
  const double dt = 1.0 / 960.0;
  const auto bias = [&](Drift law, double step, double gap) {
    blocks[1].phi[0] = gap;
    set_drift_bias(blocks, law, tau, step);
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
      w = gyroscopic_implicit(I, w, before, dt);
      before = dt;
      p = at_pose(w, dt);
    }
    EXPECT_NEAR(p.norm(), p0.norm(), 1e-11 * p0.norm());
    EXPECT_NEAR(p.dot(p.cwiseQuotient(I)), p0.dot(p0.cwiseQuotient(I)), 1e-10 * p0.squaredNorm());
  }
}

}  // namespace
}  // namespace substep::test
