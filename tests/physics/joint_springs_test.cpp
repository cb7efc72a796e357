// Springs and dampers of hinges and slides: they move as drives without bounds, beside bounded
// drives, and their energy is part of the energy.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/lab/verdict.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "tests/support/joint_methods.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

/// Two rods of unequal moments in space, a hinge and a slide, without gravity.
SceneBuilder rods_in_space() {
  SceneBuilder builder("sprung rods");
  const int arm = builder.add_body(Box{{0.4, 0.05, 0.1}}, 1.0, {0.4, 0.0, 0.0});
  const int slider = builder.add_body(Box{{0.1, 0.2, 0.05}}, 0.5, {0.8, 0.3, 0.0});
  builder.body(arm).collides = builder.body(slider).collides = false;
  builder.add_hinge(arm, kWorld, Vec3::Zero(), Vec3(1.0, 2.0, 3.0).normalized());
  builder.add_prismatic(slider, arm, {0.8, 0.0, 0.0}, Vec3(1.0, 1.0, 0.0).normalized());
  builder.scene().gravity = {0.0, -3.0, 0.0};
  return builder;
}

TEST(JointSprings, MoveAsDrivesWithoutBounds) {
  const Spring springs[] = {{0.3, 20.0, 0.2}, {-0.1, 300.0, 0.5}};
  SceneBuilder sprung = rods_in_space();
  SceneBuilder driven = rods_in_space();
  for (int joint = 0; joint < 2; ++joint) {
    const Spring& spring = springs[joint];
    sprung.add_spring(joint, spring);
    driven.drive(
        joint,
        Drive{.target = spring.rest, .stiffness = spring.stiffness, .damping = spring.damping});
  }
  const auto with_springs = std::make_shared<const Scene>(*sprung.build());
  EXPECT_TRUE(with_springs->effects.springs);
  EXPECT_FALSE(with_springs->effects.drives);
  const auto with_drives = std::make_shared<const Scene>(*driven.build());
  for (const JointMethod& method : joint_methods()) {
    Simulator a(with_springs);
    Simulator b(with_drives);
    a.set_settings(method.settings);
    b.set_settings(method.settings);
    for (int frame = 0; frame < 20; ++frame) {
      ASSERT_EQ(a.step().status, StepStatus::kOk) << method.name;
      ASSERT_EQ(b.step().status, StepStatus::kOk) << method.name;
    }
    for (int body = 0; body < 2; ++body) {
      EXPECT_EQ(a.state().x[index(body)], b.state().x[index(body)]) << method.name;
      EXPECT_EQ(a.state().u[index(body)], b.state().u[index(body)]) << method.name;
    }
  }
}

/// A rod on a hinge about its centre, or a block on a rail; without gravity.
SceneBuilder oscillator(bool hinged, double speed, const Spring& spring) {
  SceneBuilder builder("oscillator");
  const int body = builder.add_body(Box{{0.5, 0.1, 0.1}}, 1.2, Vec3::Zero());
  const int joint = hinged ? builder.add_hinge(body, kWorld, Vec3::Zero(), Vec3::UnitZ())
                           : builder.add_prismatic(body, kWorld, Vec3::Zero(), Vec3::UnitX());
  builder.add_spring(joint, spring);
  (hinged ? builder.body(body).angular_velocity.z() : builder.body(body).velocity.x()) = speed;
  builder.scene().gravity.setZero();
  return builder;
}

// The hinge turns more than twice before it returns: k x^2/2 counts full turns.
TEST(JointSprings, StoreTheEnergyOfTheirStretch) {
  for (const bool hinged : {false, true}) {
    const double speed = hinged ? 60.0 : 2.0;
    const Scene built = *oscillator(hinged, speed, {0.2, 2.0, 0.0}).build();
    const double inertia = hinged ? built.bodies[0].inertia.z() : built.bodies[0].mass;
    const double start = 0.5 * inertia * speed * speed + 0.5 * 2.0 * 0.04;
    const double farthest = std::sqrt(start);  // of k x^2/2 = start
    if (hinged) {
      ASSERT_GT(farthest, 4.0 * std::numbers::pi);
    }
    Simulator simulator(std::make_shared<const Scene>(built));
    simulator.set_settings(steady_at(64));
    EXPECT_NEAR(simulator.observe().springs, 0.5 * 2.0 * 0.04, 1e-12);
    double most = 0.0;
    for (int frame = 0; frame < 240; ++frame) {
      const FrameReport report = simulator.step();
      ASSERT_EQ(report.status, StepStatus::kOk);
      most = std::max(most, report.springs);
      EXPECT_NEAR(report.energy, start, 1e-4 * start) << hinged << " " << frame;
      EXPECT_EQ(report.elastic, report.springs);
    }
    EXPECT_GT(most, 0.9 * start) << hinged;
  }
}

// In contrast to a drive, a spring does no work: its energy is judged, and a damper takes some. The
// stiffness of a spring does not raise N, so that 16 sub-steps are given where nothing may be lost.
TEST(JointSprings, HaveTheirEnergyJudged) {
  for (const double damping : {0.0, 0.5}) {
    SceneBuilder builder = rods_in_space();
    builder.add_spring(0, {0.5, 40.0, damping});
    builder.add_spring(1, {0.2, 200.0, damping});
    const auto scene = std::make_shared<const Scene>(*builder.build());
    Simulator simulator(scene);
    simulator.set_settings(damping == 0.0 ? steady_at(16) : steady());
    const double start = simulator.observe().energy;
    Verdict verdict(*scene, simulator.state(), simulator.observe());
    double largest = 0.0;
    FrameReport report;
    for (int frame = 0; frame < 600; ++frame) {
      report = simulator.step();
      ASSERT_EQ(report.status, StepStatus::kOk);
      verdict.add(*scene, simulator.state(), report);
      largest = std::max(largest, report.kinetic);
    }
    EXPECT_TRUE(verdict.holds()) << verdict.text();
    if (damping == 0.0) {
      EXPECT_NEAR(report.energy, start, 0.01 * largest);
    } else {
      EXPECT_LT(report.energy, start - 0.1 * largest);
    }
    report.energy = start + largest;  // what no spring may do
    verdict.add(*scene, simulator.state(), report);
    EXPECT_FALSE(verdict.holds()) << damping;
  }
}

// A drive at its bound holds the spring where the spring exerts as much.
TEST(JointSprings, AreNotBoundedByTheDriveBesideThem) {
  for (const bool hinged : {false, true}) {
    SceneBuilder builder = oscillator(hinged, 0.0, {0.0, 40.0, 4.0});
    builder.drive(0, Drive{.target = 5.0, .stiffness = 1e4, .damping = 10.0, .effort = 12.0});
    Simulator simulator(std::make_shared<const Scene>(*builder.build()));
    simulator.set_settings(steady());
    for (int frame = 0; frame < 600; ++frame) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    const State& state = simulator.state();
    const double stretch =
        hinged ? 2.0 * std::atan2(state.q[0].z(), state.q[0].w()) : state.x[0].x();
    EXPECT_NEAR(stretch, 12.0 / 40.0, 1e-6) << hinged;
  }
}

}  // namespace
}  // namespace substep::test
