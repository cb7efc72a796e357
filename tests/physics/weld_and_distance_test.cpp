// Welds and distance joints with every solver and integrator, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "core/lab/exact_motion.hpp"
#include "core/lab/forecast.hpp"
#include "core/model/scene_builder.hpp"
#include "core/model/validate.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/start.hpp"
#include "tests/support/joint_methods.hpp"

namespace substep {
namespace {

using test::const_settings;
using test::error_after;
using test::expect_order;
using test::joint_methods;
using test::JointMethod;
using test::kGravity;

class Weld : public testing::TestWithParam<JointMethod> {};
class Distance : public testing::TestWithParam<JointMethod> {};

// Two bodies whose sum has two equal moments of inertia move as one body, in closed form. The
// second one is turned, and the weld is off both centres.
TEST_P(Weld, TwoBodiesMoveAsOne) {
  constexpr double kMass[] = {2.0, 1.0};
  const Vec3 at[] = {{0.0, 0.0, -0.2}, {0.0, 0.0, 0.4}};  // their common centre is the origin
  const Vec3 drift{0.3, 0.1, -0.2};
  const Vec3 spin{1.5, -0.7, 2.0};
  double transverse = 0.0;
  double axial = 0.0;
  SceneBuilder builder;
  for (int i = 0; i < 2; ++i) {
    const int body = builder.add_body(Box{{0.1, 0.1, 0.1}}, kMass[i], at[i]);
    builder.body(body).collides = false;
    builder.body(body).inertia = Vec3(0.05, 0.05, 0.02);
    builder.body(body).angular_velocity = spin;
    builder.body(body).velocity = drift + spin.cross(at[i]);
    transverse += 0.05 + kMass[i] * at[i].squaredNorm();
    axial += 0.02;
  }
  builder.body(1).orientation = Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  builder.body(1).inertia = {0.05, 0.02, 0.05};
  builder.add_weld(1, 0, {0.1, 0.2, 0.15});
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  const auto error = [&](const State& state, double t) {
    const Attitude exact = free_symmetric_body(transverse, axial, {Quat::Identity(), spin}, t);
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      sum += (state.x[i] - (drift * t + exact.q_WB * at[i])).norm() +
             state.q[i].angularDistance(exact.q_WB * scene.bodies[i].orientation);
    }
    return sum;
  };
  JointMethod method = GetParam();
  // Numerov's forces are of second order where bodies rotate in space.
  if (method.settings.forces == Forces::kNumerov) method.order = 2;
  expect_order(scene, method, 0.5, 1e-8, error);
}

// A static force moves a compliant weld by C F; a torque rotates it by C_angular T.
TEST(WeldCompliance, YieldsByItsCompliance) {
  SceneBuilder builder;
  builder.add_body(Box{{0.2, 0.2, 0.2}}, 1.0, Vec3::Zero());
  builder.add_weld(0, kWorld, Vec3::Zero());
  builder.scene().gravity.setZero();
  auto& joint = std::get<WeldJoint>(builder.scene().joints[0]);
  joint.compliance = 1e-3;
  joint.angular_compliance = 2e-3;
  const Vec3 force{2.0, 5.0, -3.0};
  const Vec3 torque{1.0, -2.0, 4.0};
  builder.body(0).force = force;
  builder.body(0).torque = torque;
  Simulator simulator =
      test::simulator_of(*builder.build(), const_settings(SolverKind::kBpp, Integrator::kEuler, 4));
  for (int i = 0; i < 600; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
  const State& state = simulator.state();
  EXPECT_LT((state.x[0] - 1e-3 * force).norm(), 1e-7);
  // The rows have sines of the angles.
  EXPECT_LT((2.0 * state.q[0].vec() - 2e-3 * torque).norm(), 1e-4);
  const JointForce found = simulator.constraint_forces().joints[0];
  EXPECT_LT((found.force + force).norm(), 1e-6);
  EXPECT_LT((found.torque + torque).norm(), 0.05);
}

// A ball on a rod swings as the point mass of the textbook, with the force of the rod.
TEST_P(Distance, ARodSwingsAsAPendulum) {
  constexpr double kLength = 2.0;
  constexpr double kMass = 1.5;
  SceneBuilder builder;
  builder.add_body(Sphere{0.1}, kMass, {kLength, 0.0, 0.0});
  builder.add_distance(0, kWorld, {kLength, 0.0, 0.0}, Vec3::Zero());
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  const Scene scene = *builder.build();
  const auto exact = ExactPendulum::released(std::sqrt(kGravity / kLength), 0.5 * std::numbers::pi);
  expect_order(scene, GetParam(), 1.0, 2e-8, [&](const State& state, double t) {
    const double angle = exact.at(t).angle;
    return (state.x[0] - kLength * Vec3(std::sin(angle), -std::cos(angle), 0.0)).norm();
  });
}

// A conical pendulum keeps its height: omega^2 = g/(L cos theta). Its rod pulls with m g/cos theta.
TEST_P(Distance, AConicalPendulumKeepsItsHeight) {
  constexpr double kTheta = 0.6;
  constexpr double kLength = 1.2;
  const double radius = kLength * std::sin(kTheta);
  const double rate = std::sqrt(kGravity / (kLength * std::cos(kTheta)));
  SceneBuilder builder;
  const Vec3 start{radius, -kLength * std::cos(kTheta), 0.0};
  builder.add_body(Sphere{0.1}, 2.0, start);
  builder.body(0).velocity = {0.0, 0.0, -radius * rate};
  builder.add_distance(0, kWorld, start, Vec3::Zero());
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  const Scene scene = *builder.build();
  JointMethod method = GetParam();
  if (method.settings.forces == Forces::kNumerov) method.order = 2;  // as for Weld
  expect_order(scene, method, 1.0, 2e-8, [&](const State& state, double t) {
    const Vec3 exact{radius * std::cos(rate * t), start.y(), -radius * std::sin(rate * t)};
    return (state.x[0] - exact).norm();
  });
  Settings fine = method.settings;
  fine.n = 64;
  Simulator simulator = test::simulator_of(scene, fine);
  for (int i = 0; i < 30; ++i) simulator.step();
  const double pull = 2.0 * kGravity / std::cos(kTheta);
  EXPECT_NEAR(simulator.constraint_forces().joints[0].force.norm(), pull, 2e-3 * pull);
}

// A weight on a spring: y = -(m g C)(1 - cos(t/sqrt(m C))).
TEST_P(Distance, WithComplianceItIsASpring) {
  constexpr double kMass = 2.0;
  constexpr double kCompliance = 1e-2;
  SceneBuilder builder;
  builder.add_body(Sphere{0.1}, kMass, {0.0, -1.0, 0.0});
  builder.add_distance(0, kWorld, {0.0, -1.0, 0.0}, Vec3::Zero());
  base(builder.scene().joints[0]).compliance = kCompliance;
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  const Scene scene = *builder.build();
  expect_order(scene, GetParam(), 1.0, 2e-8, [&](const State& state, double t) {
    const double stretch =
        kMass * kGravity * kCompliance * (1.0 - std::cos(t / std::sqrt(kMass * kCompliance)));
    return (state.x[0] - Vec3(0.0, -1.0 - stretch, 0.0)).norm();
  });
}

// The stretch is part of the motion; its energy belongs to the total.
TEST(DistanceSpring, HasNoGap) {
  SceneBuilder builder;
  builder.add_body(Sphere{0.1}, 2.0, {0.0, -1.0, 0.0});
  builder.add_distance(0, kWorld, {0.0, -1.0, 0.0}, Vec3::Zero());
  base(builder.scene().joints[0]).compliance = 1e-2;
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  Simulator simulator = test::simulator_of(*builder.build(), substep::Settings{});
  const double energy = simulator.observe().energy;
  double stretch = 0.0;
  for (int i = 0; i < 60; ++i) {
    const FrameReport report = simulator.step();
    EXPECT_EQ(report.joint_gap, 0.0);
    EXPECT_EQ(report.constraint_error, 0.0);
    EXPECT_NEAR(report.energy, energy, 0.02 * 2.0 * kGravity * 0.4) << i;
    keep_largest(stretch, -1.0 - simulator.state().x[0].y());
  }
  EXPECT_GT(stretch, 0.3);
}

/// Two free bodies of unequal inertia at the ends of a rod, off their centres.
Scene dumbbell() {
  SceneBuilder builder;
  builder.add_body(Box{{0.4, 0.1, 0.2}}, 2.0, {0.5, 0.4, -0.2});
  builder.add_body(Box{{0.1, 0.3, 0.2}}, 5.0, {-0.5, 0.1, 0.3});
  for (int i = 0; i < 2; ++i) builder.body(i).collides = false;
  const Vec3 spin{0.7, -0.4, 0.9};
  builder.body(0).angular_velocity = builder.body(1).angular_velocity = spin;
  builder.body(0).velocity = spin.cross(builder.body(0).position - builder.body(1).position);
  builder.add_distance(0, 1, {0.3, 0.45, -0.1}, {-0.4, 0.2, 0.3});
  builder.scene().gravity.setZero();
  builder.scene().name = builder.scene().title = "dumbbell";
  return *builder.build();
}

// No external force acts: the momentum is conserved, the energy to the order of the method.
TEST_P(Distance, KeepsTheMomentumOfTwoFreeBodies) {
  const Scene scene = dumbbell();
  Settings settings = GetParam().settings;
  double drift[2] = {};
  for (int k = 0; k < 2; ++k) {
    settings.n = 8 << k;
    Simulator simulator = test::simulator_of(scene, settings);
    const Momenta start = momenta_of(scene, simulator.state());
    const FrameReport before = simulator.observe();
    FrameReport report;
    for (int i = 0; i < 60; ++i) report = simulator.step();
    const Momenta end = momenta_of(scene, simulator.state());
    // Rounding of 960 sub-steps, with XPBD of 400 iterations each.
    EXPECT_LT((end.linear - start.linear).norm(), 5e-12);
    drift[k] = std::abs(report.energy - before.energy) / before.energy;
    EXPECT_LT(report.joint_gap, 2e-3);
  }
  const double shrinks = std::pow(2.0, GetParam().order);
  EXPECT_LT(drift[1], std::max(1e-9, 1.3 * drift[0] / shrinks)) << drift[0];
}

// A platform on six rods is statically determinate: nothing moves, and the rods carry it.
TEST_P(Distance, SixRodsCarryAPlatform) {
  constexpr double kMass = 3.0;
  SceneBuilder builder;
  builder.add_body(Box{{0.5, 0.05, 0.5}}, kMass, {0.05, 1.0, 0.02});
  for (int i = 0; i < 6; ++i) {
    const double top = std::numbers::pi / 3.0 * (i + (i % 2 == 0 ? 0.2 : -0.2));
    const double foot = std::numbers::pi / 3.0 * (i + (i % 2 == 0 ? -0.3 : 0.3));
    builder.add_distance(0, kWorld, {0.5 * std::cos(top), 1.0, 0.5 * std::sin(top)},
                         {0.8 * std::cos(foot), 0.0, 0.8 * std::sin(foot)});
  }
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  const Scene scene = *builder.build();
  Simulator simulator = test::simulator_of(scene, GetParam().settings);
  for (int i = 0; i < 60; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
  const SolverKind solver = GetParam().settings.solver;
  const bool sweeps = solver == SolverKind::kPgs || solver == SolverKind::kXpbd;
  EXPECT_LT((simulator.state().x[0] - scene.bodies[0].position).norm(), sweeps ? 1e-4 : 1e-12);
  Vec3 sum = Vec3::Zero();
  for (const JointForce& rod : simulator.constraint_forces().joints) sum += rod.force;
  EXPECT_LT((sum - kMass * Vec3(0.0, kGravity, 0.0)).norm(), sweeps ? 0.1 : 1e-9);
}

TEST_P(Distance, ContinuesFromASceneFileBitForBit) {
  Scene scene = dumbbell();
  WeldJoint weld;  // of a third body, aligned with the first
  weld.name = "weld";
  weld.a = 2;
  weld.b = 0;
  weld.anchor_b = {0.1, 0.0, 0.3};
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[2].name = "third";
  scene.bodies[2].position += Vec3(0.1, 0.0, 0.3);
  scene.bodies[2].velocity += scene.bodies[0].angular_velocity.cross(Vec3(0.1, 0.0, 0.3));
  scene.joints.emplace_back(weld);
  test::expect_continues(scene, GetParam().settings);
}

// A rod of another length is closed before the run.
TEST(DistanceStart, ARodOfAnotherLengthIsClosed) {
  Scene scene = dumbbell();
  std::get<DistanceJoint>(scene.joints[0]).length += 0.02;
  const Start start = start_of_run(scene);
  EXPECT_TRUE(start.report.projected);
  EXPECT_NEAR(start.report.found.gap, 0.02, 1e-12);
  EXPECT_LT(start.report.left.gap, 1e-12);
  EXPECT_LT(start.report.left.speed, 1e-10);
}

TEST(DistanceStart, ARodMustReachItsBodies) {
  Scene scene = dumbbell();
  std::get<DistanceJoint>(scene.joints[0]).length = 10.0;
  base(scene.joints[0]).compliance = 1e-9;  // a stiff one, too
  const Problems problems = validate(scene);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(to_string(problems[0]).find("/joints/0: the anchors start"), std::string::npos)
      << to_string(problems[0]);
}

// Two balls on a stretched spring oscillate about its length; it may even start at zero.
TEST(DistanceStart, ASpringMayStartStretched) {
  for (const double start : {1.5, 0.0}) {
    SceneBuilder builder;
    builder.add_body(Sphere{0.05}, 1.0, {0.0, 0.0, 0.0});
    builder.add_body(Sphere{0.05}, 2.0, {start, 0.0, 0.0});
    for (int i = 0; i < 2; ++i) builder.body(i).collides = false;
    builder.add_distance(1, 0, {start, 0.0, 0.0}, Vec3::Zero());
    auto& spring = std::get<DistanceJoint>(builder.scene().joints[0]);
    spring.length = 1.0;
    spring.compliance = 0.05;
    builder.scene().gravity.setZero();
    const auto scene = builder.build();
    ASSERT_TRUE(validate(*scene).empty()) << to_string(validate(*scene)[0]);
    Settings settings;
    settings.mode = Mode::kConst;
    settings.n = 16;
    settings.integrator = Integrator::kStormer;
    Simulator simulator = test::simulator_of(scene, settings);
    const double rate = std::sqrt(1.5 / 0.05);                        // of the reduced mass 2/3 kg
    const double turn = start > 0.0 ? std::numbers::pi / rate : 0.1;  // before it passes zero
    while (simulator.state().time < turn) {
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const double apart = 1.0 + (start - 1.0) * std::cos(rate * simulator.state().time);
      EXPECT_NEAR(simulator.state().x[1].x() - simulator.state().x[0].x(), apart, 1e-6);
    }
  }
}

// Five unequal boxes on rods in space, one between two centres of mass, with the default settings:
// nothing opens, and the energy stays within 1 % of its range.
TEST(DistanceDefault, AChainOfRodsKeepsItsEnergyAndStaysClosed) {
  SceneBuilder builder;
  Vec3 end = Vec3::Zero();
  for (int i = 0; i < 5; ++i) {
    const Vec3 at = end + Vec3(0.4, 0.05 * i, 0.1);
    builder.add_body(Box{{0.1, 0.03 + 0.02 * i, 0.05}}, 0.5 + 0.4 * i, at);
    builder.body(i).velocity = {0.0, 0.0, 0.4 * i};
    const Vec3 on_a = i == 2 ? at : Vec3(at + Vec3(0.05, -0.02, 0.03));
    builder.add_distance(i, i - 1, on_a, end);
    end = i == 1 ? at : Vec3(at + Vec3(-0.04, 0.02, 0.0));
  }
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  Scene scene = *builder.build();
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  Simulator simulator = test::simulator_of(scene, substep::Settings{});
  const double energy = simulator.observe().energy;
  double lowest = 0.0;
  double changed = 0.0;
  for (int i = 0; i < 600; ++i) {
    const FrameReport report = simulator.step();
    ASSERT_EQ(report.status, StepStatus::kOk);
    EXPECT_LT(report.joint_gap, 1e-12) << i;
    lowest = std::min(lowest, report.potential);
    keep_largest(changed, std::abs(report.energy - energy));
  }
  EXPECT_LT(changed, -0.01 * lowest);
}

// N follows the tension of the rod: k/m = f/(L m), the square of the rate of small swings.
TEST(DistanceStiffness, IsTheRateOfThePendulum) {
  SceneBuilder builder;
  builder.add_body(Sphere{0.1}, 3.0, {0.0, -0.5, 0.0});
  builder.add_distance(0, kWorld, {0.0, -0.5, 0.0}, Vec3::Zero());
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  substep::Settings settings;
  settings.alpha = 0.001;
  Simulator simulator = test::simulator_of(*builder.build(), settings);
  simulator.step();
  const FrameReport report = simulator.step();
  EXPECT_NEAR(report.r_stiffness, kGravity / 0.5, 1e-9);
  EXPECT_GT(report.n_substeps, 1);
  EXPECT_EQ(forecast(*builder.build(), settings).hanging, report.n_substeps);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Weld, testing::ValuesIn(joint_methods()),
                         [](const auto& method) { return method.param.name; });
INSTANTIATE_TEST_SUITE_P(EveryMethod, Distance, testing::ValuesIn(joint_methods()),
                         [](const auto& method) { return method.param.name; });

}  // namespace
}  // namespace substep
