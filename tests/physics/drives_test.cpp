// Drives of hinges and slides: against the closed forms of a spring with a damper, at their bounds,
// in arms and loops, over full turns.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/lab/verdict.hpp"
#include "core/math/angle.hpp"
#include "core/math/turn.hpp"
#include "core/model/scene_builder.hpp"
#include "core/model/validate.hpp"
#include "core/sim/conserved.hpp"
#include "tests/support/joint_methods.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

constexpr double kDriveFrame = 1.0 / 60.0;  // [s]

/// A rod of 1 kg and 1 m on a hinge at its end, or a block on a rail; without gravity.
SceneBuilder driven(bool hinged, double speed, const Drive& drive) {
  SceneBuilder builder("driven");
  const int body = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
  const int joint = hinged ? builder.add_hinge(body, kWorld, Vec3::Zero(), Vec3::UnitZ())
                           : builder.add_prismatic(body, kWorld, {0.5, 0.0, 0.0}, Vec3::UnitX());
  builder.drive(joint, drive);
  if (hinged) {
    builder.body(body).angular_velocity = {0.0, 0.0, speed};
    builder.body(body).velocity = {0.0, 0.5 * speed, 0.0};
  } else {
    builder.body(body).velocity = {speed, 0.0, 0.0};
  }
  builder.scene().frame = kDriveFrame;
  builder.scene().gravity.setZero();
  return builder;
}

double inertia_of(const Scene& scene, bool hinged) {
  return hinged ? scene.bodies[0].inertia.z() + 0.25 : 1.0;
}

double angle_of_body(const Quat& q) { return 2.0 * angle_of(q.z(), q.w()); }

double coordinate(const State& state, bool hinged) {
  return hinged ? angle_of_body(state.q[0]) : state.x[0].x() - 0.5;
}

/// Distance from the target of m x'' + c x' + k x = 0.
double spring_and_damper(double m, double c, double k, double x, double v, double t) {
  const double g = 0.5 * c / m;
  const double square = k / m - g * g;
  if (square > 0.0) {
    const double w = std::sqrt(square);
    return std::exp(-g * t) * (x * std::cos(w * t) + (v + g * x) / w * std::sin(w * t));
  }
  const double w = std::sqrt(-square);
  const double slow = -k / m / (g + w);
  const double fast = -g - w;
  const double b = (v - slow * x) / (fast - slow);
  return (x - b) * std::exp(slow * t) + b * std::exp(fast * t);
}

struct DriveRegime {
  const char* name;
  double stiffness;
  double damping;
};

double regime_error(const DriveRegime& regime, bool hinged, const Settings& settings) {
  constexpr double kTarget = 0.5;
  constexpr double kSpeed = 1.0;
  const Drive drive{.target = kTarget, .stiffness = regime.stiffness, .damping = regime.damping};
  const Scene scene = *driven(hinged, kSpeed, drive).build();
  const double m = inertia_of(scene, hinged);
  return error_after(scene, settings, 1.0, [&](const State& state, double t) {
    const double exact =
        spring_and_damper(m, regime.damping, regime.stiffness, -kTarget, kSpeed, t);
    return std::abs(coordinate(state, hinged) - kTarget - exact);
  });
}

// First order with implicit Euler, second with all that have springs of higher order.
TEST(Drives, FollowTheClosedFormOfASpringAndADamper) {
  for (const DriveRegime& regime :
       {DriveRegime{"underdamped", 50.0, 0.5}, DriveRegime{"nearly critical", 50.0, 8.1},
        DriveRegime{"overdamped", 50.0, 40.0}, DriveRegime{"a damper", 0.0, 2.0}}) {
    for (const JointMethod& method : joint_methods()) {
      for (const bool hinged : {false, true}) {
        const int order = std::min(method.order, 2);
        Settings finer = method.settings;
        finer.n *= 4;
        const double coarse = regime_error(regime, hinged, method.settings);
        const double fine = regime_error(regime, hinged, finer);
        const std::string name = std::string(regime.name) + " " + method.name;
        EXPECT_LT(coarse, order == 1 ? 0.05 : 2e-4) << name;
        EXPECT_LT(fine, 1.35 * coarse / std::pow(4.0, order)) << name << " " << hinged;
      }
    }
  }
}

// The default settings, with N decided by the scene.
TEST(Drives, AreOfSecondOrderByDefault) {
  for (const bool hinged : {false, true}) {
    const DriveRegime regime{"underdamped", 50.0, 0.5};
    EXPECT_LT(regime_error(regime, hinged, steady_at(1)), 5e-3);
    EXPECT_LT(regime_error(regime, hinged, steady_at(4)), 3e-4);
    EXPECT_LT(regime_error(regime, hinged, steady_at(32)), 5e-6);
  }
}

// Whatever the gains and the step, the energy of the spring and of the motion falls, but for the
// half sub-step between poses and velocities: the largest resolved frequency is 0.3 per sub-step.
TEST(Drives, StayBoundedWhateverTheirGains) {
  for (const double stiffness : {0.0, 1e-2, 1e2, 1e4, 1e6, 1e12}) {
    for (const double damping : {0.0, 1e-2, 1e2, 1e4, 1e6, 1e12}) {
      if (stiffness == 0.0 && damping == 0.0) continue;
      const Drive drive{.target = 0.3, .stiffness = stiffness, .damping = damping};
      const Scene scene = *driven(true, 2.0, drive).build();
      const double moment = inertia_of(scene, true);
      const double start = 0.5 * moment * 4.0 + 0.5 * stiffness * 0.09;
      for (JointMethod method : joint_methods()) {
        for (const int n : {1, 3}) {
          method.settings.n = n;
          Simulator simulator = simulator_of(scene, method.settings);
          double most = 0.0;
          for (int i = 0; i < 60; ++i) {
            ASSERT_EQ(simulator.step().status, StepStatus::kOk) << method.name;
            const double off = angle_of_body(simulator.state().q[0]) - 0.3;
            const double speed = simulator.state().u[0][5];
            keep_largest(most, 0.5 * moment * speed * speed + 0.5 * stiffness * off * off);
          }
          EXPECT_LT(most, 1.2 * start) << method.name << " " << stiffness << " " << damping;
        }
      }
    }
  }
}

/// Five links, level at the start, each with a drive.
SceneBuilder arm(const Drive& drive) {
  SceneBuilder builder("arm");
  int last = kWorld;
  for (int i = 0; i < 5; ++i) {
    const int body = builder.add_body(Box{{0.2, 0.03, 0.03}}, 2.0, {0.2 + 0.4 * i, 0.0, 0.0});
    builder.body(body).collides = false;
    const int hinge = builder.add_hinge(body, last, {0.4 * i, 0.0, 0.0}, Vec3::UnitZ());
    builder.drive(hinge, drive);
    last = body;
  }
  builder.scene().frame = kDriveFrame;
  return builder;
}

/// Largest error of an angle of the arm [rad], and of its speed [rad/s].
struct ArmError {
  double angle = 0.0;
  double speed = 0.0;
};
ArmError error_of_arm(const State& state, double target) {
  ArmError error;
  for (std::size_t i = 0; i < state.q.size(); ++i) {
    const Quat before = i > 0 ? state.q[i - 1] : Quat(Quat::Identity());
    keep_largest(error.angle,
                 std::abs(wrapped(angle_of_body(before.conjugate() * state.q[i]) - target)));
    keep_largest(error.speed, state.u[i].tail<3>().norm());
  }
  return error;
}

// Stiff gains that explicit drives could hold only with thousands of sub-steps. The static error is
// at most the moment of the weight of the whole arm over the stiffness.
TEST(Drives, HoldAnArmAtEveryN) {
  constexpr double kStiffness = 1e5;
  constexpr double kTarget = 0.3;
  const Scene scene = *arm({.target = kTarget, .stiffness = kStiffness, .damping = 2000.0}).build();
  const double sag = 5 * 2.0 * kGravity * 1.0 / kStiffness;
  for (const int n : {0, 1, 2, 4, 16}) {
    for (const Integrator integrator :
         {Integrator::kEuler, Integrator::kLeapfrog, Integrator::kStormer}) {
      Settings settings = steady_at(n);
      settings.integrator = integrator;
      Simulator simulator = simulator_of(scene, settings);
      for (int i = 0; i < 120; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const ArmError error = error_of_arm(simulator.state(), kTarget);
      EXPECT_LT(error.angle, sag) << n << " " << static_cast<int>(integrator);
      EXPECT_GT(error.angle, 0.1 * sag) << n;
      EXPECT_LT(error.speed, 1e-4) << n << " " << static_cast<int>(integrator);
    }
  }
  for (const JointMethod& method : joint_methods()) {
    for (const int n : {1, 4}) {
      Settings settings = method.settings;
      settings.n = n;
      Simulator simulator = simulator_of(scene, settings);
      for (int i = 0; i < 120; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const ArmError error = error_of_arm(simulator.state(), kTarget);
      // With one sub-step the sweeps have not quite converged.
      EXPECT_LT(error.angle, entry_of(settings.solver).sweeps && n == 1 ? 2.5 * sag : sag)
          << method.name << " " << n;
      EXPECT_LT(error.speed, 1e-3) << method.name << " " << n;
    }
  }
}

TEST(Drives, SagByTheLoadOverTheirStiffness) {
  constexpr double kStiffness = 100.0;
  for (const JointMethod& method : joint_methods()) {
    SceneBuilder builder = driven(false, 0.0, {.stiffness = kStiffness, .damping = 20.0});
    builder.scene().gravity = {-3.0, 0.0, 0.0};
    Simulator simulator = simulator_of(*builder.build(), method.settings);
    for (int i = 0; i < 240; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_NEAR(coordinate(simulator.state(), false), -3.0 / kStiffness, 1e-9) << method.name;
    EXPECT_NEAR(simulator.constraint_forces().joints[0].force.x(), 3.0, 1e-6) << method.name;
  }
}

TEST(Drives, StallAtExactlyTheirBound) {
  const double load = 1.0 * kGravity * 0.5;
  for (const JointMethod& method : joint_methods()) {
    for (const bool holds : {false, true}) {
      SceneBuilder builder = driven(
          true, 0.0, {.stiffness = 1e4, .damping = 500.0, .effort = (holds ? 1.2 : 0.8) * load});
      builder.scene().gravity = {0.0, -kGravity, 0.0};
      const Scene scene = *builder.build();
      Simulator simulator = simulator_of(scene, method.settings);
      for (int i = 0; i < 30; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const double torque = simulator.constraint_forces().joints[0].torque.z();
      const double angle = coordinate(simulator.state(), true);
      if (holds) {
        EXPECT_NEAR(angle, -load / 1e4, 2e-6) << method.name;
        EXPECT_NEAR(torque, load, 0.01 * load) << method.name;
      } else {  // it falls with 0.2 of its weight at first
        const double slow = -0.5 * 0.2 * load / inertia_of(scene, true) * 0.25;
        EXPECT_NEAR(angle, slow, 0.1 * std::abs(slow)) << method.name;
        EXPECT_NEAR(torque, 0.8 * load, 1e-9 * load) << method.name;
      }
    }
  }
}

// c (v - x') = load.
TEST(Drives, FollowTheVelocityThatTheyAreGiven) {
  for (const JointMethod& method : joint_methods()) {
    SceneBuilder builder = driven(false, 0.0, {.velocity = 0.4, .damping = 30.0});
    builder.scene().gravity = {-3.0, 0.0, 0.0};
    Simulator simulator = simulator_of(*builder.build(), method.settings);
    for (int i = 0; i < 90; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_NEAR(simulator.state().u[0].x(), 0.4 - 3.0 / 30.0, 1e-9) << method.name;
  }
}

// The angle counts turns; it starts between -pi and pi.
TEST(Drives, TurnAHingeMoreThanOnce) {
  for (const double target : {20.0, -9.0, 3.5}) {
    for (const int n : {0, 1, 8}) {
      const Scene scene =
          *driven(true, 0.0, {.target = target, .stiffness = 4.0, .damping = 2.5}).build();
      Simulator simulator = simulator_of(scene, steady_at(n));
      double turned = 0.0;
      double last = 0.0;
      double most = 0.0;
      for (int i = 0; i < 400; ++i) {
        ASSERT_EQ(simulator.step().status, StepStatus::kOk);
        const double angle = angle_of_body(simulator.state().q[0]);
        turned += wrapped(angle - last);
        last = angle;
        keep_largest(most, std::abs(turned));
      }
      EXPECT_NEAR(turned, target, 1e-3) << n;
      EXPECT_LT(most, 1.05 * std::abs(target)) << n;
    }
  }
}

TEST(Drives, ARunContinuesBitForBitFromAFileOverFullTurns) {
  SceneBuilder builder = arm({.target = 7.0, .stiffness = 40.0, .damping = 4.0, .effort = 60.0});
  for (const int n : {0, 4}) {
    Simulator whole = simulator_of(*builder.build(), steady_at(n));
    for (int i = 0; i < 45; ++i) whole.step();
    const Scene saved = saved_scene(whole.scene(), whole.state(), whole.settings());
    const SceneResult read = read_scene(write_scene(saved));
    for (const Problem& problem : read.problems) ADD_FAILURE() << to_string(problem);
    ASSERT_TRUE(read.scene);
    Simulator rest(read.scene);
    for (int i = 0; i < 90; ++i) {
      ASSERT_EQ(whole.step().status, StepStatus::kOk);
      rest.step();
      ASSERT_EQ(whole.state().x, rest.state().x) << n << " " << i;
      ASSERT_EQ(whole.state().u, rest.state().u) << n << " " << i;
    }
  }
}

// Two free bodies on a slide through their centres: the reduced mass moves as one on a spring.
TEST(Drives, OfAFreePairMoveItsReducedMass) {
  const Vec3 rail = Vec3(2.0, -1.0, 2.0) / 3.0;
  constexpr double kStiffness = 30.0;
  constexpr double kDamping = 1.5;
  for (const bool hinged : {false, true}) {
    SceneBuilder builder("pair");
    const int a = builder.add_body(Box{{0.1, 0.2, 0.2}}, 2.0, 0.4 * rail);
    const int b = builder.add_body(Box{{0.2, 0.1, 0.1}}, 0.7, -0.4 * rail);
    for (const int body : {a, b}) {
      builder.body(body).collides = false;
      builder.body(body).orientation = turn_between(Vec3::UnitX(), rail);
    }
    const int joint = hinged ? builder.add_hinge(a, b, Vec3::Zero(), rail)
                             : builder.add_prismatic(a, b, Vec3::Zero(), rail);
    builder.drive(joint, {.target = 0.2, .stiffness = kStiffness, .damping = kDamping});
    if (hinged) {
      builder.body(a).angular_velocity = 1.5 * rail;
    } else {
      builder.body(a).velocity = 1.5 * rail;
    }
    builder.scene().frame = kDriveFrame;
    builder.scene().gravity.setZero();
    const Scene scene = *builder.build();
    const auto of = [&](int body) {
      const Body& at = scene.bodies[index(body)];
      return hinged ? at.inertia.x() : at.mass;
    };
    const double reduced = of(a) * of(b) / (of(a) + of(b));
    const Vec3 across = rail.unitOrthogonal();
    for (const int n : {4, 16}) {
      Simulator simulator = simulator_of(scene, steady_at(n));
      const Momenta start = momenta_of(scene, simulator.state());
      double error = 0.0;
      for (int i = 0; i < 60; ++i) {
        ASSERT_EQ(simulator.step().status, StepStatus::kOk);
        const State& state = simulator.state();
        const Quat turned_a = state.q[0] * scene.bodies[0].orientation.conjugate();
        const Quat turned_b = state.q[1] * scene.bodies[1].orientation.conjugate();
        const double x = hinged ? angle_about(rail, turned_b * across, turned_a * across)
                                : rail.dot(state.x[0] - state.x[1]) - 0.8;
        const double exact =
            spring_and_damper(reduced, kDamping, kStiffness, -0.2, 1.5, state.time);
        keep_largest(error, std::abs(x - 0.2 - exact));
      }
      const Momenta end = momenta_of(scene, simulator.state());
      EXPECT_LT((end.linear - start.linear).norm(), 1e-12);
      EXPECT_LT((end.angular - start.angular).norm(), 1e-12);
      EXPECT_LT(error, (hinged ? 0.1 : 5e-3) / (n * n)) << n << " " << hinged;
    }
  }
}

// The rows of a parallelogram are redundant.
TEST(Drives, KeepALoopClosed) {
  SceneBuilder builder("parallelogram");
  const Box upright{{0.03, 0.25, 0.03}};
  const int left = builder.add_body(upright, 1.0, {0.0, 0.25, 0.0});
  const int right = builder.add_body(upright, 1.0, {1.0, 0.25, 0.0});
  const int top = builder.add_body(Box{{0.5, 0.03, 0.03}}, 2.0, {0.5, 0.5, 0.0});
  for (const int body : {left, right, top}) builder.body(body).collides = false;
  const int first = builder.add_hinge(left, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_hinge(right, kWorld, {1.0, 0.0, 0.0}, Vec3::UnitZ());
  builder.add_hinge(top, left, {0.0, 0.5, 0.0}, Vec3::UnitZ());
  builder.add_hinge(top, right, {1.0, 0.5, 0.0}, Vec3::UnitZ());
  for (const bool bounded : {false, true}) {
    Drive drive{.target = 0.5, .stiffness = 400.0, .damping = 20.0};
    if (bounded) drive.effort = 300.0;
    builder.drive(first, drive);
    const Scene scene = *builder.build();
    for (const int n : {0, 4}) {
      Simulator simulator = simulator_of(scene, steady_at(n));
      for (int i = 0; i < 180; ++i) {
        const FrameReport report = simulator.step();
        ASSERT_EQ(report.status, StepStatus::kOk);
        EXPECT_LT(report.joint_gap, 1e-11) << n << " " << i;
      }
      // k (target - x) is the moment of the weight, 3 kg at half a metre, which tips the bars over.
      const double x = angle_of_body(simulator.state().q[0]);
      EXPECT_NEAR(400.0 * (0.5 - x), -3.0 * kGravity * 0.5 * std::sin(x), 1e-3) << n;
    }
  }
}

// Random trees in space with drives of any strength, some of them with limits: default settings.
TEST(Drives, OfRandomLinkagesStayFinite) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double lo, double hi) {
      return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
    };
    const auto vector = [&] {
      const double x = uniform(-1.0, 1.0);
      const double y = uniform(-1.0, 1.0);
      return Vec3(x, y, uniform(-1.0, 1.0));
    };
    SceneBuilder builder("linkage");
    Vec3 at = Vec3::Zero();
    int last = kWorld;
    const auto bodies = static_cast<int>(1 + random() % 5);
    for (int i = 0; i < bodies; ++i) {
      const double half = uniform(0.05, 0.3);
      const Vec3 along = vector().normalized();
      const double mass = std::exp(uniform(-3.0, 3.0));
      const int body = builder.add_body(Box{{half, 0.05, 0.03}}, mass, at + half * along);
      builder.body(body).orientation = turn_between(Vec3::UnitX(), along);
      builder.body(body).collides = false;
      if (i > 0 || seed % 4 > 0) {
        const bool slides = random() % 3 == 0;
        const int joint = slides ? builder.add_prismatic(body, last, at, vector())
                                 : builder.add_hinge(body, last, at, vector());
        Drive drive{.target = slides ? uniform(-0.3, 0.3) : uniform(-9.0, 9.0)};
        drive.velocity = random() % 2 == 0 ? 0.0 : uniform(-2.0, 2.0);
        drive.stiffness = random() % 4 == 0 ? 0.0 : std::exp(uniform(-7.0, 20.0));
        drive.damping =
            drive.stiffness > 0.0 && random() % 4 == 0 ? 0.0 : std::exp(uniform(-7.0, 20.0));
        if (random() % 2 == 0) drive.effort = std::exp(uniform(-3.0, 7.0));
        builder.drive(joint, drive);
        if (random() % 4 == 0) builder.limit(joint, -0.4, 0.5, uniform(0.0, 1.0));
      }
      last = body;
      at += 2.0 * half * along;
    }
    Simulator simulator = simulator_of(*builder.build(), steady());
    for (int i = 0; i < 60; ++i) {
      const FrameReport report = simulator.step();
      ASSERT_EQ(report.status, StepStatus::kOk) << seed;
      ASSERT_TRUE(std::isfinite(report.energy)) << seed;
      ASSERT_LT(report.joint_gap, 1e-6) << seed;
    }
  }
}

// A drive pushes a rod onto its bound, where it rebounds as under a torque, and then rests.
TEST(Drives, PressAgainstALimit) {
  for (const SolverKind solver : kAllSolvers) {
    SceneBuilder builder = driven(true, 0.0, {.target = 2.0, .stiffness = 3.0, .damping = 0.1});
    builder.limit(0, -1.0, 1.0, 0.5);
    Settings settings = steady_at(4);
    settings.solver = solver;
    settings.iterations = 400;
    Simulator simulator = simulator_of(*builder.build(), settings);
    double turned_back = 0.0;
    for (int i = 0; i < 480; ++i) {
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      turned_back = std::min(turned_back, simulator.state().u[0][5]);
    }
    EXPECT_LT(turned_back, -0.5) << static_cast<int>(solver);
    EXPECT_NEAR(angle_of_body(simulator.state().q[0]), 1.0, 1e-4) << static_cast<int>(solver);
    EXPECT_LT(std::abs(simulator.state().u[0][5]), 0.01) << static_cast<int>(solver);
  }
}

// Slower than what counts as rest, until it is there.
// However slow they are: one that is damped, one that is weak, and one that has a velocity only.
TEST(Drives, DoNotFallAsleepOnTheirWay) {
  Settings settings = steady();
  settings.sleep = true;
  for (const Drive& drive :
       {Drive{.target = 0.01, .stiffness = 2.0, .damping = 20.0},
        Drive{.target = 0.01, .stiffness = 1e-6}, Drive{.velocity = 0.001, .damping = 20.0}}) {
    Simulator simulator = simulator_of(*driven(true, 0.0, drive).build(), settings);
    for (int i = 0; i < 300; ++i) EXPECT_EQ(simulator.step().asleep, 0);
    EXPECT_GT(angle_of_body(simulator.state().q[0]), 1e-7);
  }
}

// They do work: the energy is not judged.
TEST(Drives, AreNotJudgedByTheEnergy) {
  const Scene scene = *arm({.target = 1.0, .stiffness = 300.0, .damping = 30.0}).build();
  Simulator simulator = simulator_of(scene, steady());
  const FrameReport start = simulator.observe();
  Verdict verdict(scene, simulator.state(), start);
  double most = start.energy;
  for (int i = 0; i < 120; ++i) {
    const FrameReport report = simulator.step();
    keep_largest(most, report.energy);
    verdict.add(scene, simulator.state(), report);
  }
  EXPECT_GT(most, start.energy + 5.0);
  EXPECT_TRUE(verdict.holds()) << verdict.text();
}

}  // namespace
}  // namespace substep::test
