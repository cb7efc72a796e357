// Impacts that propagate between bodies within a sub-step.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/model/names.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "tests/support/run.hpp"

namespace substep {
namespace {

using test::kAllSolvers;

constexpr double kRadius = 0.1;  // [m]
constexpr double kSpeed = 2.0;   // of the striking ball [m/s]

/// Balls without gravity, of 1 kg.
class Balls {
 public:
  explicit Balls(double e) : e_(e) {
    Scene& scene = builder_.scene();
    scene.gravity.setZero();
    scene.contact.compliance = 1e-16;
  }
  Body& add(const Vec3& position, double mass = 1.0) {
    Body& body = builder_.body(builder_.add_body(Sphere{kRadius}, mass, position));
    body.restitution = e_;
    body.friction = 0.0;
    return body;
  }
  SceneBuilder& builder() { return builder_; }

  /// Where they are after some frames, which take one sub-step each.
  State after(int frames, SolverKind solver) {
    PaperSettings settings;
    settings.mode = Mode::kNone;
    settings.solver = solver;
    settings.iterations = 200;
    Simulator simulator(builder_.build());
    simulator.set_settings(settings);
    for (int i = 0; i < frames; ++i) EXPECT_EQ(simulator.step().status, StepStatus::kOk);
    return simulator.state();
  }

 private:
  SceneBuilder builder_{"balls"};
  double e_;
};

// Huygens: in a row of equal touching balls, the last one leaves with the speed of the first.
TEST(Impacts, PassThroughARowOfBallsThatTouch) {
  for (const SolverKind solver : kAllSolvers) {
    Balls balls(1.0);
    balls.add({-0.5, 0.0, 0.0}).velocity.x() = kSpeed;
    for (int i = 0; i < 4; ++i) balls.add({2.0 * kRadius * i, 0.0, 0.0});
    const State end = balls.after(20, solver);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(end.u[i].norm(), 1e-6) << name_of(solver);
    EXPECT_NEAR(end.u[4][0], kSpeed, 1e-6) << name_of(solver);
  }
}

// The same with a heavy last ball: the row returns the remaining momentum, and no energy is lost.
TEST(Impacts, KeepMomentumAndEnergyOfUnequalBalls) {
  for (const SolverKind solver : kAllSolvers) {
    Balls balls(1.0);
    const double masses[] = {2.0, 1.0, 0.5, 5.0};
    balls.add({-0.5, 0.0, 0.0}, masses[0]).velocity.x() = kSpeed;
    for (int i = 1; i < 4; ++i) balls.add({2.0 * kRadius * i, 0.0, 0.0}, masses[i]);
    const State end = balls.after(30, solver);
    double momentum = 0.0;
    double energy = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      momentum += masses[i] * end.u[i][0];
      energy += 0.5 * masses[i] * end.u[i].head<3>().squaredNorm();
    }
    EXPECT_NEAR(momentum, 2.0 * kSpeed, 1e-6) << name_of(solver);
    EXPECT_NEAR(energy, kSpeed * kSpeed, 1e-6) << name_of(solver);
  }
}

// With e < 1 a ball keeps (1 - e)/2 of its speed, strikes the next one again, and so on until all
// approach speeds are below the threshold; pair by pair, as in closed form.
TEST(Impacts, LoseEnergyByTheirRestitution) {
  constexpr double e = 0.8;
  constexpr double kSlow = 1e-3;  // [m/s]
  std::vector<double> expected{kSpeed, 0.0, 0.0, 0.0};
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i + 1 < expected.size(); ++i) {
      const double approach = expected[i] - expected[i + 1];
      if (approach < kSlow) continue;
      expected[i] -= 0.5 * (1.0 + e) * approach;
      expected[i + 1] += 0.5 * (1.0 + e) * approach;
      any = true;
    }
  }
  for (const SolverKind solver : kAllSolvers) {
    Balls balls(e);
    balls.builder().scene().contact.restitution_speed = kSlow;
    balls.add({-0.5, 0.0, 0.0}).velocity.x() = kSpeed;
    for (int i = 0; i < 3; ++i) balls.add({2.0 * kRadius * i, 0.0, 0.0});
    const State end = balls.after(20, solver);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(end.u[i][0], expected[i], 2.0 * kSlow) << name_of(solver);
    }
  }
}

// Two balls side by side, struck midway, separate symmetrically, whichever is listed first.
TEST(Impacts, KeepSymmetry) {
  const double side = 2.0 * kRadius * std::sqrt(0.75);
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kNewton}) {
    Balls balls(1.0);
    balls.add({-0.5, 0.0, 0.0}).velocity.x() = kSpeed;
    balls.add({side, kRadius, 0.0});
    balls.add({side, -kRadius, 0.0});
    balls.add({2.0 * side, 0.0, 0.0});
    const State end = balls.after(30, solver);
    EXPECT_NEAR(end.u[1][0], end.u[2][0], 1e-9) << name_of(solver);
    EXPECT_NEAR(end.u[1][1], -end.u[2][1], 1e-9) << name_of(solver);
    EXPECT_NEAR(end.u[3][1], 0.0, 1e-9) << name_of(solver);
    double energy = 0.0;
    for (const Vec6& u : end.u) energy += 0.5 * u.head<3>().squaredNorm();
    EXPECT_NEAR(energy, 0.5 * kSpeed * kSpeed, 1e-6) << name_of(solver);
  }
}

// A ball on a hinged arm transmits an impulse: the joint takes part in every impact.
TEST(Impacts, PassThroughBodiesOnJoints) {
  Balls balls(1.0);
  balls.add({-0.5, 0.0, 0.0}).velocity.x() = kSpeed;
  for (int i = 0; i < 3; ++i) {
    const Vec3 at{2.0 * kRadius * i, 0.0, 0.0};
    balls.add(at);
    balls.builder().add_ball_joint(i + 1, kWorld, at + Vec3(0.0, 1.0, 0.0));
  }
  balls.add({6.0 * kRadius, 0.0, 0.0});
  const State end = balls.after(20, SolverKind::kBpp);
  // An arm of 1 m about its joint has an effective mass larger than the ball's by 0.4 r^2, and the
  // impulse passes through bodies that are heavier by that amount.
  double energy = 0.0;
  for (const Vec6& u : end.u) {
    energy +=
        0.5 * u.head<3>().squaredNorm() + 0.5 * 0.4 * kRadius * kRadius * u.tail<3>().squaredNorm();
  }
  EXPECT_NEAR(energy, 0.5 * kSpeed * kSpeed, 1e-4);
  EXPECT_GT(end.u[4][0], 0.99 * kSpeed);
}

// A landing column loses no energy, however many of its balls strike at once.
TEST(Impacts, OfALandingColumnLoseNoEnergy) {
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    Balls balls(1.0);
    for (int i = 0; i < 4; ++i) {
      balls.add({0.0, 0.5 + 2.0 * kRadius * i, 0.0}).velocity.y() = -kSpeed;
    }
    balls.builder().add_fixed(Plane{}, Vec3::Zero());
    const State end = balls.after(40, solver);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(end.u[i][1], kSpeed, 1e-6) << name_of(solver);
  }
}

}  // namespace
}  // namespace substep
