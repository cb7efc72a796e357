// Prismatic joints with every solver and integrator, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/math/turn.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/start.hpp"
#include "tests/support/joint_methods.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/run.hpp"

namespace substep {
namespace {

using test::const_settings;
using test::error_after;
using test::expect_order;
using test::joint_methods;
using test::JointMethod;

constexpr double kFrame = 1.0 / 60.0;

class Prismatic : public testing::TestWithParam<JointMethod> {};

// s = g sin(theta) t^2/2 down a rail, for a body that hangs off it with an offset centre.
TEST_P(Prismatic, SlidesDownAnInclinedRail) {
  const Vec3 rail = Vec3(4.0, -3.0, 0.0) / 5.0;
  SceneBuilder builder;
  const int box = builder.add_body(Box{{0.2, 0.1, 0.3}}, 3.0, {0.3, 0.2, 0.4});
  builder.add_prismatic(box, kWorld, {0.0, 0.0, 0.0}, rail);
  builder.scene().frame = kFrame;
  const Scene scene = *builder.build();
  const Vec3 start = scene.bodies[0].position;
  const Quat attitude = scene.bodies[0].orientation;
  const auto error = [&](const State& state, double t) {
    const Vec3 exact = start + 0.5 * 9.81 * 0.6 * t * t * rail;
    return (state.x[0] - exact).norm() + state.q[0].angularDistance(attitude);
  };
  // There is no curvature: methods that are not of first order are exact.
  const JointMethod& method = GetParam();
  if (method.order > 1) {
    EXPECT_LT(error_after(scene, method.settings, 1.0, error), 1e-11);
  } else {
    expect_order(scene, method, 1.0, 1e-8, error);
  }
}

// A bead on a very heavy rod that rotates at a constant rate: r = r_0 cosh(w t).
TEST_P(Prismatic, SlidesOutwardOnATurningRod) {
  constexpr double kRate = 2.0;   // [rad/s]
  constexpr double kStart = 0.2;  // [m]
  SceneBuilder builder;
  const int rod = builder.add_body(Box{{0.5, 0.02, 0.02}}, 1e9, Vec3::Zero());
  const int bead = builder.add_body(Sphere{0.05}, 0.5, {kStart, 0.0, 0.0});
  builder.body(rod).inertia = 1e9 * Vec3::Ones();
  builder.body(rod).collides = builder.body(bead).collides = false;
  builder.body(rod).angular_velocity = builder.body(bead).angular_velocity = {0.0, 0.0, kRate};
  builder.body(bead).velocity = {0.0, kRate * kStart, 0.0};
  builder.add_prismatic(bead, rod, {kStart, 0.0, 0.0}, Vec3::UnitX());
  builder.scene().frame = kFrame;
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  const auto error = [&](const State& state, double t) {
    const double r = kStart * std::cosh(kRate * t);
    return (state.x[1] - r * Vec3(std::cos(kRate * t), std::sin(kRate * t), 0.0)).norm();
  };
  expect_order(scene, GetParam(), 0.5, 2e-8, error);
}

// Two free bodies of unequal inertia that slide on each other off their centres: no external force
// acts, so both momenta are conserved, and the energy is conserved to the order of the method.
TEST_P(Prismatic, KeepsTheMomentaOfTwoFreeBodies) {
  SceneBuilder builder;
  const int a = builder.add_body(Box{{0.4, 0.1, 0.2}}, 2.0, {0.5, 0.4, -0.2});
  const int b = builder.add_body(Box{{0.1, 0.3, 0.2}}, 5.0, {-0.3, 0.1, 0.3});
  builder.body(a).collides = builder.body(b).collides = false;
  const Vec3 spin{0.7, -0.4, 0.9};
  const Vec3 axis = Vec3(1.0, 2.0, 2.0) / 3.0;
  const Vec3 apart = builder.body(a).position - builder.body(b).position;
  builder.body(a).angular_velocity = builder.body(b).angular_velocity = spin;
  builder.body(a).velocity = spin.cross(apart) + 0.8 * axis;
  builder.add_prismatic(a, b, {0.1, 0.2, 0.1}, axis);
  builder.scene().frame = kFrame;
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  Settings settings = GetParam().settings;
  double largest_drift = 0.0;
  double last_drift = 0.0;
  for (const int n : {8, 16}) {
    settings.n = n;
    Simulator simulator = test::simulator_of(scene, settings);
    const Momenta start = momenta_of(scene, simulator.state());
    const FrameReport before = simulator.observe();
    FrameReport report;
    for (int i = 0; i < 60; ++i) report = simulator.step();
    const Momenta end = momenta_of(scene, simulator.state());
    EXPECT_LT((end.linear - start.linear).norm(), 1e-12);
    last_drift = std::abs(report.energy - before.energy) / before.energy;
    if (n == 8) largest_drift = last_drift;
    EXPECT_LT(report.joint_gap, 2e-3);
  }
  const double shrinks = std::pow(2.0, GetParam().order);
  EXPECT_LT(last_drift, std::max(1e-9, 1.3 * largest_drift / shrinks)) << largest_drift;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Prismatic, testing::ValuesIn(joint_methods()),
                         [](const auto& method) { return method.param.name; });

// A slider-crank: x = r cos(a) + sqrt(l^2 - r^2 sin(a)^2), a loop of three hinges and a prismatic
// joint whose rows are redundant in its plane.
TEST(PrismaticLoop, ASliderFollowsItsCrank) {
  constexpr double kCrank = 0.5;
  constexpr double kRod = 1.2;
  const double angle = 0.9;
  const Vec3 pin{kCrank * std::cos(angle), kCrank * std::sin(angle), 0.0};
  const Vec3 wrist{pin.x() + std::sqrt(kRod * kRod - pin.y() * pin.y()), 0.0, 0.0};
  SceneBuilder builder;
  const auto bar = [&](const Vec3& from, const Vec3& to, double mass) {
    const int body =
        builder.add_body(Box{{0.5 * (to - from).norm(), 0.03, 0.05}}, mass, 0.5 * (from + to));
    builder.body(body).orientation = turn_between(Vec3::UnitX(), to - from);
    return body;
  };
  const int crank = bar(Vec3::Zero(), pin, 2.0);
  const int rod = bar(pin, wrist, 1.0);
  const int slider = builder.add_body(Box{{0.1, 0.08, 0.08}}, 4.0, wrist);
  for (const int body : {crank, rod, slider}) builder.body(body).collides = false;
  builder.add_hinge(crank, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_hinge(rod, crank, pin, Vec3::UnitZ());
  builder.add_hinge(slider, rod, wrist, Vec3::UnitZ());
  builder.add_prismatic(slider, kWorld, wrist, Vec3::UnitX());
  builder.scene().frame = kFrame;
  const Scene scene = *builder.build();
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    Simulator simulator =
        test::simulator_of(scene, const_settings(SolverKind::kBpp, integrator, 16));
    const double energy = simulator.observe().energy;
    double off = 0.0;
    double drift = 0.0;
    double lowest = wrist.x();
    for (int i = 0; i < 240; ++i) {
      const FrameReport report = simulator.step();
      ASSERT_EQ(report.status, StepStatus::kOk);
      const State& state = simulator.state();
      const Vec3 crank_end = 2.0 * state.x[0];
      const double sine = crank_end.y() / kCrank;
      const double x = crank_end.x() + std::sqrt(kRod * kRod - kCrank * kCrank * sine * sine);
      keep_largest(off, std::abs(state.x[2].x() - x) + std::abs(state.x[2].y()));
      keep_largest(drift, std::abs(report.energy - energy));
      lowest = std::min(lowest, state.x[2].x());
    }
    const bool fourth = integrator == Integrator::kStormer;
    EXPECT_LT(off, fourth ? 1e-8 : 1e-5) << off;
    EXPECT_LT(drift, fourth ? 1e-4 : 0.02) << drift;
    EXPECT_LT(lowest, 0.8);  // it has swung through
  }
}

// A static force across the axis moves a compliant joint by C F; a torque rotates it by C_angular
// T.
TEST(PrismaticCompliance, YieldsByItsCompliance) {
  SceneBuilder builder;
  const int box = builder.add_body(Box{{0.2, 0.2, 0.2}}, 1.0, Vec3::Zero());
  builder.add_prismatic(box, kWorld, Vec3::Zero(), Vec3::UnitX());
  Scene& scene = builder.scene();
  scene.gravity.setZero();
  scene.frame = kFrame;
  auto& joint = std::get<PrismaticJoint>(scene.joints[0]);
  joint.compliance = 1e-3;
  joint.angular_compliance = 2e-3;
  scene.bodies[0].force = {0.0, 5.0, -3.0};
  scene.bodies[0].torque = {1.0, -2.0, 4.0};
  Settings settings = const_settings(SolverKind::kBpp, Integrator::kEuler, 4);
  Simulator simulator = test::simulator_of(*builder.build(), settings);
  for (int i = 0; i < 600; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
  const State& state = simulator.state();
  EXPECT_LT((state.x[0] - Vec3(0.0, 5e-3, -3e-3)).norm(), 1e-7);
  // The rows have sines of the angles.
  EXPECT_LT((2.0 * state.q[0].vec() - 2e-3 * Vec3(1.0, -2.0, 4.0)).norm(), 1e-4);
  const JointForce force = simulator.constraint_forces().joints[0];
  EXPECT_LT((force.force + Vec3(0.0, 5.0, -3.0)).norm(), 1e-6);
  EXPECT_LT((force.torque + Vec3(1.0, -2.0, 4.0)).norm(), 0.05);
}

/// Two free bodies of unequal inertia on a rail of a third, which hangs on a ball joint.
Scene sliders_on_a_swing() {
  SceneBuilder builder;
  const int swing = builder.add_body(Box{{0.6, 0.05, 0.1}}, 3.0, {0.0, 0.0, 0.0});
  const int a = builder.add_body(Box{{0.1, 0.2, 0.05}}, 1.0, {0.2, 0.1, 0.1});
  const int b = builder.add_body(Box{{0.15, 0.05, 0.1}}, 2.0, {-0.3, -0.1, 0.2});
  for (const int body : {swing, a, b}) builder.body(body).collides = false;
  builder.add_ball_joint(swing, kWorld, {0.1, 0.8, 0.0});
  builder.add_prismatic(a, swing, {0.2, 0.0, 0.0}, Vec3::UnitX());
  builder.add_prismatic(b, a, {0.0, 0.0, 0.1}, {1.0, 1.0, 0.0});
  builder.scene().name = "sliders";
  builder.scene().title = "Sliders";
  return *builder.build();
}

// Gaps along the axis are not errors; gaps across it and tilts are corrected.
TEST(PrismaticStart, OffItsRailIsProjectedOntoIt) {
  Scene scene = sliders_on_a_swing();
  scene.bodies[1].position += Vec3(0.3, 0.02, -0.03);
  scene.bodies[2].orientation = Quat(1.0, 0.01, 0.02, -0.01).normalized();
  scene.bodies[1].velocity = {1.0, 0.5, 0.0};
  const Start start = start_of_run(scene);
  EXPECT_TRUE(start.report.projected);
  EXPECT_GT(start.report.found.gap, 0.02);
  EXPECT_LT(start.report.found.gap, 0.3);
  EXPECT_GT(start.report.found.tilt, 0.02);
  EXPECT_LT(start.report.left.gap, 1e-12);
  EXPECT_LT(start.report.left.tilt, 1e-12);
  EXPECT_LT(start.report.left.speed, 1e-10);
  EXPECT_LT(start.report.left.turning, 1e-10);
}

TEST_P(Prismatic, ContinuesFromASceneFileBitForBit) {
  test::expect_continues(sliders_on_a_swing(), GetParam().settings);
}

// The order in which bodies and joints are listed changes only rounding.
TEST_P(Prismatic, IsTheSameInAnotherOrderOfTheFile) {
  const Scene scene = sliders_on_a_swing();
  Scene other = scene;
  std::reverse(other.bodies.begin(), other.bodies.end());
  std::reverse(other.joints.begin(), other.joints.end());
  for (Joint& joint : other.joints) {
    JointBase& j = base(joint);
    j.a = 2 - j.a;
    if (j.b != kWorld) j.b = 2 - j.b;
  }
  Simulator first = test::simulator_of(scene, GetParam().settings);
  Simulator second = test::simulator_of(other, GetParam().settings);
  for (int i = 0; i < 30; ++i) {
    ASSERT_EQ(first.step().status, StepStatus::kOk);
    ASSERT_EQ(second.step().status, StepStatus::kOk);
  }
  // Sweeps process the joints in their order and stop before convergence.
  const SolverKind solver = GetParam().settings.solver;
  const bool sweeps = solver == SolverKind::kPgs || solver == SolverKind::kXpbd;
  for (std::size_t body = 0; body < 3; ++body) {
    const double apart = (first.state().x[body] - second.state().x[2 - body]).norm();
    EXPECT_LT(apart, sweeps ? 1e-5 : 1e-10);
  }
}

}  // namespace
}  // namespace substep
