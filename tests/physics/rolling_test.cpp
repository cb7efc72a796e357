// Balls of unequal moments that roll and slide, in space, against the classical Runge-Kutta method.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/model/names.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

constexpr double kBallRadius = 0.3;  // [m]
constexpr double kHillRadius = 1.0;  // [m]
constexpr double kBallMass = 2.0;    // [kg]

/// Position, orientation, velocity and angular velocity of the ball, in the world.
struct BallMotion {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero();
  Vec3 omega = Vec3::Zero();
};

struct BallRates {
  Vec3 v;
  Quat q;
  Vec3 a;
  Vec3 alpha;
};

BallMotion moved(const BallMotion& from, const BallRates& by, double dt) {
  BallMotion to;
  to.x = from.x + dt * by.v;
  to.q.coeffs() = from.q.coeffs() + dt * by.q.coeffs();
  to.q.normalize();
  to.v = from.v + dt * by.a;
  to.omega = from.omega + dt * by.alpha;
  return to;
}

/// Fourth order.
BallMotion integrated(BallMotion motion, const std::function<BallRates(const BallMotion&)>& rates,
                      double seconds) {
  constexpr int kSteps = 4000;
  const double h = seconds / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const BallRates k1 = rates(motion);
    const BallRates k2 = rates(moved(motion, k1, 0.5 * h));
    const BallRates k3 = rates(moved(motion, k2, 0.5 * h));
    const BallRates k4 = rates(moved(motion, k3, h));
    BallRates sum;
    sum.v = (k1.v + 2.0 * k2.v + 2.0 * k3.v + k4.v) / 6.0;
    sum.q.coeffs() =
        (k1.q.coeffs() + 2.0 * k2.q.coeffs() + 2.0 * k3.q.coeffs() + k4.q.coeffs()) / 6.0;
    sum.a = (k1.a + 2.0 * k2.a + 2.0 * k3.a + k4.a) / 6.0;
    sum.alpha = (k1.alpha + 2.0 * k2.alpha + 2.0 * k3.alpha + k4.alpha) / 6.0;
    motion = moved(motion, sum, h);
  }
  return motion;
}

Quat rate_of(const BallMotion& motion) {
  const Quat spin(0.0, motion.omega.x(), motion.omega.y(), motion.omega.z());
  Quat rate = spin * motion.q;
  rate.coeffs() *= 0.5;
  return rate;
}

Mat3 inertia_of(const Vec3& I, const Quat& q) {
  const Mat3 R = q.toRotationMatrix();
  return R * I.asDiagonal() * R.transpose();
}

/// A ball on the ground, a plane or a ball about the origin.
struct BallScene {
  Scene scene;
  bool on_hill = false;
  [[nodiscard]] BallMotion start() const {
    const Body& ball = scene.bodies[1];
    return {ball.position, ball.orientation, ball.velocity, ball.angular_velocity};
  }
  [[nodiscard]] Vec3 normal(const Vec3& x) const {
    return on_hill ? Vec3(x.normalized()) : Vec3(Vec3::UnitY());
  }
};

BallScene ball_on(Random& random, bool hill, double friction) {
  BallScene made;
  made.on_hill = hill;
  Scene& scene = made.scene;
  scene.effects.gravity = scene.effects.contact = scene.effects.friction = true;
  scene.effects.gyroscopic = true;
  scene.gravity = {uniform(random), -8.0, uniform(random)};
  Body ground = hill ? test::fixed(Sphere{kHillRadius}) : test::fixed(Plane{});
  Body ball = test::moving(Sphere{kBallRadius}, kBallMass);
  ball.inertia = {uniform(random, 0.05, 0.07), uniform(random, 0.07, 0.09),
                  uniform(random, 0.09, 0.11)};
  ball.orientation = random_rotation(random);
  ball.angular_velocity = 2.0 * random_vector(random);
  const Vec3 n = hill ? Vec3(0.2 * uniform(random), 1.0, 0.2 * uniform(random)).normalized()
                      : Vec3(Vec3::UnitY());
  ball.position = hill ? Vec3((kHillRadius + kBallRadius) * n) : Vec3(kBallRadius * n);
  ground.friction = ball.friction = friction;
  scene.bodies = {ground, ball};
  return made;
}

// v = r omega x n, and with n' = v/(R + r) on a hill
//   I omega' + omega x I omega = -r n x f,   f = m (r (omega' x n + omega x n') - g).
BallMotion rolled(const BallScene& made, double seconds) {
  const Body& ball = made.scene.bodies[1];
  return integrated(
      made.start(),
      [&](const BallMotion& now) -> BallRates {
        const Vec3 n = made.normal(now.x);
        const Vec3 v = kBallRadius * now.omega.cross(n);
        const Vec3 turning =
            made.on_hill ? Vec3(v / (kHillRadius + kBallRadius)) : Vec3(Vec3::Zero());
        const Mat3 I = inertia_of(ball.inertia, now.q);
        const Mat3 about =
            I + kBallMass * kBallRadius * kBallRadius * (Mat3::Identity() - n * n.transpose());
        const Vec3 known = kBallRadius * now.omega.cross(turning) - made.scene.gravity;
        const Vec3 torque =
            -now.omega.cross(I * now.omega) - kBallMass * kBallRadius * n.cross(known);
        return {v, rate_of(now), Vec3::Zero(), about.inverse() * torque};
      },
      seconds);
}

// Coulomb's force against the sliding, on a plane.
BallMotion slid(const BallScene& made, double mu, double seconds) {
  const Body& ball = made.scene.bodies[1];
  return integrated(
      made.start(),
      [&](const BallMotion& now) -> BallRates {
        const Vec3 arm = -kBallRadius * Vec3::UnitY();
        Vec3 sliding = now.v + now.omega.cross(arm);
        sliding.y() = 0.0;
        Vec3 pull = made.scene.gravity;
        const Vec3 force = mu * kBallMass * pull.y() * sliding.normalized();
        pull.y() = 0.0;
        const Mat3 I = inertia_of(ball.inertia, now.q);
        const Vec3 torque = arm.cross(force) - now.omega.cross(I * now.omega);
        return {now.v, rate_of(now), pull + force / kBallMass, I.inverse() * torque};
      },
      seconds);
}

struct BallMethod {
  SolverKind solver;
  Forces forces;
  Integrator integrator;
};

std::string name_of_method(const BallMethod& method) {
  return std::string(name_of(method.solver)) + " " + std::string(name_of(method.forces)) + " " +
         std::string(name_of(method.integrator));
}

/// Those that claim more than first order.
constexpr BallMethod kHigherOrder[] = {
    {SolverKind::kBpp, Forces::kEnd, Integrator::kLeapfrog},
    {SolverKind::kBpp, Forces::kEnd, Integrator::kStormer},
    {SolverKind::kNewton, Forces::kMean, Integrator::kLeapfrog},
    {SolverKind::kNewton, Forces::kNumerov, Integrator::kLeapfrog},
};

/// Of position, and of rotation at the surface [m].
double error_of(const BallScene& made, const BallMethod& method, int n, const BallMotion& expected,
                double seconds) {
  substep::Settings settings = steady_at(n);
  settings.solver = method.solver;
  settings.forces = method.forces;
  settings.integrator = method.integrator;
  settings.iterations = 100;
  Simulator simulator = simulator_of(made.scene, settings);
  const int frames = static_cast<int>(std::lround(seconds / made.scene.frame));
  for (int i = 0; i < frames; ++i) simulator.step();
  const State& end = simulator.state();
  const Quat apart = end.q[1].conjugate() * expected.q;
  return (end.x[1] - expected.x).norm() + kBallRadius * 2.0 * apart.vec().norm();
}

// What softness adds to the error: contacts creep.
double creep(int n) { return 3e-7 / n; }

/// Over four doublings.
void expect_second_order(const BallScene& made, const BallMotion& expected, double seconds,
                         int trial) {
  constexpr double kOrder = 1.9;
  for (const BallMethod& method : kHigherOrder) {
    double coarse = error_of(made, method, 4, expected, seconds);
    EXPECT_LT(coarse, 2e-3) << trial << " " << name_of_method(method);
    for (int n = 8; n <= 64; n *= 2) coarse /= std::pow(2.0, kOrder);
    const double fine = error_of(made, method, 64, expected, seconds);
    EXPECT_LT(fine, coarse + creep(64)) << trial << " " << name_of_method(method);
  }
}

TEST(Rolling, IsOfSecondOrderOnAPlaneAndOnABall) {
  Random random(51);
  constexpr double kSeconds = 0.5;
  for (int trial = 0; trial < 6; ++trial) {
    BallScene made = ball_on(random, trial % 2 == 1, 1.0);
    Body& ball = made.scene.bodies[1];
    ball.velocity = kBallRadius * ball.angular_velocity.cross(made.normal(ball.position));
    expect_second_order(made, rolled(made, kSeconds), kSeconds, trial);
  }
}

constexpr double kSlidingSeconds = 0.4;
constexpr double kSlidingFriction = 0.2;

BallScene sliding_ball(Random& random) {
  BallScene made = ball_on(random, false, kSlidingFriction);
  made.scene.bodies[1].velocity = {0.0, 0.0, 6.0};
  made.scene.bodies[1].angular_velocity = {-10.0, 5.0, 20.0};
  return made;
}

TEST(Sliding, OfChangingDirectionIsOfSecondOrder) {
  Random random(52);
  for (int trial = 0; trial < 4; ++trial) {
    const BallScene made = sliding_ball(random);
    const BallMotion expected = slid(made, kSlidingFriction, kSlidingSeconds);
    expect_second_order(made, expected, kSlidingSeconds, trial);
  }
}

// Bodies of unequal moments do not slide along the force: what friction does across the sliding
// shows.
TEST(Sliding, FollowsCoulombsLawWithEverySolver) {
  Random random(53);
  const BallScene made = sliding_ball(random);
  const BallMotion expected = slid(made, kSlidingFriction, kSlidingSeconds);
  for (const SolverKind solver : kAllSolvers) {
    for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
      const BallMethod method{solver, Forces::kEnd, integrator};
      const double coarse = error_of(made, method, 8, expected, kSlidingSeconds);
      const double fine = error_of(made, method, 32, expected, kSlidingSeconds);
      EXPECT_LT(fine, 1e-3) << name_of_method(method);
      EXPECT_GT(coarse / fine, 3.5) << name_of_method(method) << " " << coarse << " " << fine;
    }
  }
}

}  // namespace
}  // namespace substep::test
