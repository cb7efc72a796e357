// Dry friction of hinges and slides, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/lab/verdict.hpp"
#include "core/math/angle.hpp"
#include "core/model/scene_builder.hpp"
#include "tests/support/joint_methods.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

constexpr double kRubbedFrame = 1.0 / 60.0;  // [s]

/// A rod of 1 kg and 1 m on a hinge at its end with friction, level.
SceneBuilder rubbed(double effort, double speed, bool falls) {
  SceneBuilder builder("rubbed");
  const int body = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
  builder.rub(builder.add_hinge(body, kWorld, Vec3::Zero(), Vec3::UnitZ()), effort);
  builder.body(body).angular_velocity = {0.0, 0.0, speed};
  builder.body(body).velocity = {0.0, 0.5 * speed, 0.0};
  builder.scene().frame = kRubbedFrame;
  if (!falls) builder.scene().gravity.setZero();
  return builder;
}

double moment_of(const Scene& scene) { return scene.bodies[0].inertia.z() + 0.25; }

double rubbed_angle(const State& state) { return 2.0 * angle_of(state.q[0].z(), state.q[0].w()); }

// At the time I w/T, after the angle I w^2/(2 T), and not back.
TEST(JointFriction, StopsASpinningRod) {
  constexpr double kTorque = 0.5;
  for (const JointMethod& method : joint_methods()) {
    for (const double speed : {1.0, -1.0}) {
      const Scene scene = *rubbed(kTorque, speed, false).build();
      const double moment = moment_of(scene);
      const double stops = moment / kTorque;
      Simulator simulator = simulator_of(scene, method.settings);
      for (int i = 0; i < 90; ++i) {
        ASSERT_EQ(simulator.step().status, StepStatus::kOk);
        const double t = simulator.state().time;
        const double left = t < stops ? speed * (1.0 - t / stops) : 0.0;
        if (std::abs(t - stops) < kRubbedFrame / 8.0) continue;  // within the sub-step
        EXPECT_NEAR(simulator.state().u[0][5], left,
                    t < stops ? 1.1 * kTorque / moment / 960.0 : 1e-9)
            << method.name << " " << t;
      }
      const double angle = speed * 0.5 * stops;
      EXPECT_NEAR(rubbed_angle(simulator.state()), angle, method.order == 1 ? 2e-3 : 1e-5)
          << method.name;
    }
  }
}

TEST(JointFriction, HoldsBelowItsBoundAndSlipsAbove) {
  const double load = kGravity * 0.5;
  for (const JointMethod& method : joint_methods()) {
    for (const int n : {1, 8}) {
      Settings settings = method.settings;
      settings.n = n;
      const Scene holds = *rubbed(1.05 * load, 0.0, true).build();
      Simulator still = simulator_of(holds, settings);
      for (int i = 0; i < 600; ++i) ASSERT_EQ(still.step().status, StepStatus::kOk);
      EXPECT_NEAR(rubbed_angle(still.state()), 0.0, 1e-9) << method.name;
      EXPECT_NEAR(still.constraint_forces().joints[0].torque.z(), load, 1e-6) << method.name;
      const Scene slips = *rubbed(0.8 * load, 0.0, true).build();
      Simulator falling = simulator_of(slips, settings);
      for (int i = 0; i < 15; ++i) ASSERT_EQ(falling.step().status, StepStatus::kOk);
      const double fallen = -0.5 * 0.2 * load / moment_of(slips) / 16.0;
      EXPECT_NEAR(rubbed_angle(falling.state()), fallen, 0.15 * std::abs(fallen)) << method.name;
      EXPECT_NEAR(falling.constraint_forces().joints[0].torque.z(), 0.8 * load, 1e-9 * load)
          << method.name;
    }
  }
}

// A block on a tilted rail in space: (m g sin - F)/m.
TEST(JointFriction, OfASlideInSpace) {
  const Vec3 rail = Vec3(4.0, -6.0, 3.0).normalized();
  const double pull = -3.0 * kGravity * rail.y();
  for (const JointMethod& method : joint_methods()) {
    for (const double share : {0.6, 1.1}) {
      SceneBuilder builder("slide");
      const int box = builder.add_body(Box{{0.2, 0.1, 0.3}}, 3.0, {0.3, 0.2, 0.4});
      builder.rub(builder.add_prismatic(box, kWorld, Vec3::Zero(), rail), share * pull);
      const Scene scene = *builder.build();
      const Vec3 start = scene.bodies[0].position;
      const double a = share < 1.0 ? (1.0 - share) * pull / 3.0 : 0.0;
      const double error =
          error_after(scene, method.settings, 0.5, [&](const State& state, double t) {
            return (state.x[0] - start - 0.5 * a * t * t * rail).norm();
          });
      EXPECT_LT(error, a == 0.0 ? 1e-9 : method.order == 1 ? 2e-3 : 1e-6) << method.name;
    }
  }
}

// Beside a motor, a drive and a limit: each has its own torque.
TEST(JointFriction, ActsBesideMotorsDrivesAndLimits) {
  for (const SolverKind solver : kAllSolvers) {
    Settings settings = steady_at(4);
    settings.solver = solver;
    settings.iterations = 400;
    const std::string name = std::to_string(static_cast<int>(solver));
    const auto run = [&](const SceneBuilder& builder, int frames) {
      Simulator simulator = simulator_of(*builder.build(), settings);
      for (int i = 0; i < frames; ++i) EXPECT_EQ(simulator.step().status, StepStatus::kOk);
      return simulator;
    };
    SceneBuilder motor = rubbed(0.3, 0.0, false);
    motor.drive(0, 100.0, 0.5);
    const double rate = 0.2 / moment_of(*motor.build());
    EXPECT_NEAR(run(motor, 30).state().u[0][5], 0.5 * rate, 0.02 * rate) << name;
    // A drive that is within T/k of its target is held there.
    SceneBuilder held = rubbed(0.3, 0.0, false);
    held.drive(0, {.target = 0.1, .stiffness = 2.0, .damping = 0.1});
    EXPECT_NEAR(rubbed_angle(run(held, 120).state()), 0.0, 1e-9) << name;
    SceneBuilder moved = rubbed(0.3, 0.0, false);
    moved.drive(0, {.target = 0.5, .stiffness = 2.0, .damping = 4.0});
    const double rest = rubbed_angle(run(moved, 600).state());
    EXPECT_NEAR(rest, 0.5 - 0.3 / 2.0, 0.01) << name << ": overdamped, it stops at T/k";
    SceneBuilder limited = rubbed(0.3, 2.0, true);
    limited.limit(0, -0.5, 0.2, 0.3);
    const Simulator rests = run(limited, 240);
    EXPECT_NEAR(rubbed_angle(rests.state()), -0.5, 1e-4) << name;
    EXPECT_NEAR(rests.state().u[0][5], 0.0, 1e-6) << name;
  }
}

// The rows of the four hinges of a parallelogram are redundant where they hold it.
TEST(JointFriction, OfALoopHoldsUpToTheSumOfItsBounds) {
  constexpr double kTorque = 2.0;
  for (const JointMethod& method : joint_methods()) {
    for (const double share : {0.9, 1.1}) {
      SceneBuilder builder("parallelogram");
      const Box upright{{0.03, 0.25, 0.03}};
      const int left = builder.add_body(upright, 1.0, {0.0, 0.25, 0.0});
      const int right = builder.add_body(upright, 1.0, {1.0, 0.25, 0.0});
      const int top = builder.add_body(Box{{0.5, 0.03, 0.03}}, 2.0, {0.5, 0.5, 0.0});
      for (const int body : {left, right, top}) builder.body(body).collides = false;
      for (const int joint : {builder.add_hinge(left, kWorld, Vec3::Zero(), Vec3::UnitZ()),
                              builder.add_hinge(right, kWorld, {1.0, 0.0, 0.0}, Vec3::UnitZ()),
                              builder.add_hinge(top, left, {0.0, 0.5, 0.0}, Vec3::UnitZ()),
                              builder.add_hinge(top, right, {1.0, 0.5, 0.0}, Vec3::UnitZ())}) {
        builder.rub(joint, kTorque);
      }
      // The moment about the four hinges: 3 kg that move half a metre per radian.
      builder.scene().gravity = {share * 4.0 * kTorque / (3.0 * 0.5), 0.0, 0.0};
      Simulator simulator = simulator_of(*builder.build(), method.settings);
      for (int i = 0; i < 30; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const double angle = rubbed_angle(simulator.state());
      if (share < 1.0) {
        EXPECT_NEAR(angle, 0.0, 1e-7) << method.name;
      } else {
        EXPECT_LT(angle, -0.01) << method.name;
      }
    }
  }
}

// Friction only takes energy: it is judged.
TEST(JointFriction, OfAChainIsJudgedByTheEnergy) {
  SceneBuilder builder("chain");
  int last = kWorld;
  for (int i = 0; i < 4; ++i) {
    const int body = builder.add_body(Box{{0.2, 0.04, 0.03}}, 1.0, {0.2 + 0.4 * i, 0.0, 0.0});
    builder.body(body).collides = false;
    const Vec3 axis = i % 2 == 0 ? Vec3(0.0, 0.28, 0.96) : Vec3(0.0, 0.6, 0.8);
    builder.rub(builder.add_hinge(body, last, {0.4 * i, 0.0, 0.0}, axis), 0.8);
    last = body;
  }
  const Scene scene = *builder.build();
  EXPECT_TRUE(scene.effects.joint_friction);
  for (const int n : {0, 4}) {
    Simulator simulator = simulator_of(scene, steady_at(n));
    const FrameReport start = simulator.observe();
    Verdict verdict(scene, simulator.state(), start);
    double lowest = start.energy;
    double rise = 0.0;
    double kinetic = 0.0;
    for (int i = 0; i < 300; ++i) {
      const FrameReport report = simulator.step();
      verdict.add(scene, simulator.state(), report);
      lowest = std::min(lowest, report.energy);
      keep_largest(rise, report.energy - lowest);
      keep_largest(kinetic, report.kinetic);
    }
    EXPECT_TRUE(verdict.holds()) << verdict.text();
    EXPECT_LT(rise, 0.01 * kinetic) << n;
    EXPECT_LT(lowest, start.energy - 10.0) << n;
  }
}

TEST(JointFriction, ARunContinuesBitForBitFromAFile) {
  SceneBuilder builder = rubbed(1.0, 3.0, true);
  builder.drive(0, {.target = 2.0, .stiffness = 3.0, .damping = 0.2, .effort = 4.0});
  for (const int n : {0, 2}) expect_continues(*builder.build(), steady_at(n));
}

}  // namespace
}  // namespace substep::test
