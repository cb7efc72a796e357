// Universal and cylindrical joints with every solver and integrator, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/lab/exact_motion.hpp"
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

constexpr double kCrossFrame = 1.0 / 60.0;

class CrossAndCylinder : public testing::TestWithParam<JointMethod> {};

double moment_about(const Body& body, const Vec3& axis) {
  const Vec3 axis_B = body.orientation.conjugate() * axis;
  return axis_B.dot(body.inertia.cwiseProduct(axis_B));
}

double distance_to(const State& state, std::size_t body, const Vec3& x, const Quat& q) {
  return (state.x[body] - x).norm() + state.q[body].angularDistance(q);
}

/// A box that turns about and slides down an inclined axis, to which its principal axes are oblique
/// and its centre is at a distance: travel and angle are independent, s = g_u t^2/2, and a pendulum
/// in the gravity across the axis.
struct SwingOnAnAxis {
  static constexpr double kDistance = 0.4;  // [m]
  Scene scene;
  Vec3 axis = Vec3(4.0, -6.0, 3.0).normalized();
  Vec3 down;  // across the axis, unit
  Vec3 side;
  double along = 0.0;  // gravity along the axis [m/s^2]
  double rate = 0.0;   // of small swings [rad/s]

  SwingOnAnAxis() {
    SceneBuilder builder;
    const Vec3 gravity = builder.scene().gravity;
    along = gravity.dot(axis);
    const Vec3 across = gravity - along * axis;
    down = across.normalized();
    side = axis.cross(down);
    const int box = builder.add_body(Box{{0.3, 0.1, 0.2}}, 2.0, kDistance * side);
    Body& body = builder.body(box);
    body.orientation = Quat(0.9, 0.3, -0.2, 0.4).normalized();
    body.inertia = {0.05, 0.11, 0.08};
    builder.add_cylindrical(box, kWorld, Vec3::Zero(), axis);
    builder.scene().frame = kCrossFrame;
    const double moment = moment_about(body, axis) + body.mass * kDistance * kDistance;
    rate = std::sqrt(body.mass * across.norm() * kDistance / moment);
    scene = *builder.build();
  }

  [[nodiscard]] double error(const State& state, double t) const {
    constexpr double kStart = 0.5 * std::numbers::pi;
    const double angle = ExactPendulum::released(rate, kStart).at(t).angle;
    const Vec3 x =
        0.5 * along * t * t * axis + kDistance * (std::cos(angle) * down + std::sin(angle) * side);
    return distance_to(state, 0, x,
                       Eigen::AngleAxisd(angle - kStart, axis) * scene.bodies[0].orientation);
  }
};

TEST_P(CrossAndCylinder, ABoxSwingsAboutTheAxisAlongWhichItSlides) {
  const SwingOnAnAxis swing;
  expect_order(swing.scene, GetParam(), 0.5, 1e-9,
               [&](const State& state, double t) { return swing.error(state, t); });
}

TEST(CylindricalJoint, SwingsAndSlidesAsTheClosedForm) {
  const SwingOnAnAxis swing;
  for (JointMethod method : joint_methods()) {
    if (method.order < 4) continue;
    method.settings.n = 128;
    EXPECT_LT(error_after(swing.scene, method.settings, 2.0,
                          [&](const State& state, double t) { return swing.error(state, t); }),
              1e-9)
        << method.name;
  }
}

/// Two shafts in cylindrical bearings whose axes meet at 40 degrees, joined there by a universal
/// joint: tan(theta_2) = cos(beta) tan(theta_1). The energy gives the speed at each angle,
///   E = (I_1 + I_2 (d theta_2/d theta_1)^2) (d theta_1/dt)^2/2.
struct CardanShaft {
  static constexpr double kSpeed = 6.0;  // of the first shaft at the start [rad/s]
  double cosine = std::cos(40.0 * std::numbers::pi / 180.0);
  double sine = std::sin(40.0 * std::numbers::pi / 180.0);
  Scene scene;
  Vec3 axis[2];
  double moment[2] = {};

  CardanShaft() {
    axis[0] = Vec3::UnitX();
    axis[1] = {cosine, sine, 0.0};
    SceneBuilder builder;
    for (int i = 0; i < 2; ++i) {
      const Vec3 centre = (i == 0 ? -0.5 : 0.4) * axis[i];
      const int shaft = builder.add_body(Box{{0.2, 0.1, 0.1}}, 1.0 + i, centre);
      Body& body = builder.body(shaft);
      body.collides = false;
      body.orientation = Quat(0.9, 0.2 - i, 0.3, 0.1).normalized();  // not balanced
      body.inertia = Vec3(0.02, 0.03, 0.04) * (1.0 + 2.0 * i);
      moment[i] = moment_about(body, axis[i]);
      builder.add_cylindrical(shaft, kWorld, centre, axis[i]);
      body.angular_velocity = kSpeed * ratio(0.0, i) * axis[i];
    }
    builder.add_universal(0, 1, Vec3::Zero(), Vec3::UnitZ(), {-sine, cosine, 0.0});
    builder.scene().frame = kCrossFrame;
    builder.scene().gravity.setZero();
    scene = *builder.build();
  }

  /// Speed of a shaft relative to the first one.
  [[nodiscard]] double ratio(double angle, int shaft) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return shaft == 0 ? 1.0 : cosine / (c * c + cosine * cosine * s * s);
  }
  [[nodiscard]] double speed(double angle) const {
    const auto twice_kinetic = [&](double at) {
      const double of_second = ratio(at, 1);
      return moment[0] + moment[1] * of_second * of_second;
    };
    return kSpeed * std::sqrt(twice_kinetic(0.0) / twice_kinetic(angle));
  }
  /// Angle of the first shaft, by the classical Runge-Kutta method.
  [[nodiscard]] double angle_at(double t) const {
    constexpr int kSteps = 4000;
    const double h = t / kSteps;
    double angle = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double k1 = speed(angle);
      const double k2 = speed(angle + 0.5 * h * k1);
      const double k3 = speed(angle + 0.5 * h * k2);
      const double k4 = speed(angle + h * k3);
      angle += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    }
    return angle;
  }

  [[nodiscard]] double error(const State& state, double t) const {
    const double first = angle_at(t);
    const double second = std::atan2(cosine * std::sin(first), std::cos(first));
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const Body& body = scene.bodies[i];
      sum += distance_to(state, i, body.position,
                         Eigen::AngleAxisd(i == 0 ? first : second, axis[i]) * body.orientation);
    }
    return sum;
  }
};

TEST_P(CrossAndCylinder, ShaftsThatMeetAtAnAngleTurnAtUnequalSpeeds) {
  const CardanShaft shafts;
  expect_order(shafts.scene, GetParam(), 0.5, 1e-9,
               [&](const State& state, double t) { return shafts.error(state, t); });
}

TEST(UniversalJoint, ShaftsTurnAsTheClosedForm) {
  const CardanShaft shafts;
  for (JointMethod method : joint_methods()) {
    if (method.order < 4) continue;
    method.settings.n = 128;
    EXPECT_LT(error_after(shafts.scene, method.settings, 1.0,
                          [&](const State& state, double t) { return shafts.error(state, t); }),
              1e-9)
        << method.name;
  }
}

/// Three bodies of unequal moments, on a universal and a cylindrical joint. @param pinned the first
/// hangs from the world on another universal joint, in gravity
Scene three_bodies(bool pinned) {
  SceneBuilder builder;
  const int a = builder.add_body(Box{{0.4, 0.1, 0.2}}, 2.0, {0.5, 0.4, -0.2});
  const int b = builder.add_body(Box{{0.1, 0.3, 0.2}}, 3.0, {-0.3, 0.1, 0.3});
  const int c = builder.add_body(Box{{0.2, 0.3, 0.1}}, 1.0, {-0.7, 0.2, -0.2});
  const Vec3 hook{0.9, 0.7, 0.0};
  const Vec3 cross{0.1, 0.2, 0.1};
  const Vec3 pins[2] = {Vec3(1.0, 2.0, 2.0) / 3.0, Vec3(2.0, 1.0, -2.0) / 3.0};
  const Vec3 rail_at{-0.5, 0.1, 0.1};
  const Vec3 rail = Vec3(2.0, 6.0, 3.0) / 7.0;
  for (const int body : {a, b, c}) builder.body(body).collides = false;
  builder.body(b).orientation = Quat(0.8, -0.3, 0.2, 0.1).normalized();
  const auto move = [&](int body, const Vec3& omega, const Vec3& about, const Vec3& sliding) {
    Body& of = builder.body(body);
    of.angular_velocity += omega;
    of.velocity += omega.cross(of.position - about) + sliding;
  };
  const Vec3 spin = pinned ? Vec3(0.6 * Vec3::UnitX() - 0.9 * Vec3::UnitZ()) : Vec3(0.7, -0.4, 0.9);
  for (const int body : {a, b, c}) move(body, spin, hook, Vec3::Zero());
  for (const int body : {b, c}) move(body, 1.1 * pins[0] - 0.7 * pins[1], cross, Vec3::Zero());
  move(c, 1.3 * rail, rail_at, 0.5 * rail);
  if (pinned) builder.add_universal(a, kWorld, hook, Vec3::UnitX(), Vec3::UnitZ());
  builder.add_universal(b, a, cross, pins[0], pins[1]);
  builder.add_cylindrical(c, b, rail_at, rail);
  builder.scene().frame = kCrossFrame;
  builder.scene().name = "three_bodies";
  builder.scene().title = "Three bodies";
  if (!pinned) builder.scene().gravity.setZero();
  return *builder.build();
}

// Against the finest run: orders 1, 2 and 4.
TEST_P(CrossAndCylinder, HasTheOrderOfTheMethodInSpace) {
  const Scene scene = three_bodies(true);
  static const std::vector<State> reference = [&] {
    Simulator fine =
        test::simulator_of(scene, const_settings(SolverKind::kBpp, Integrator::kStormer, 256));
    std::vector<State> states{fine.state()};
    for (int i = 0; i < 30; ++i) {
      EXPECT_EQ(fine.step().status, StepStatus::kOk);
      states.push_back(fine.state());
    }
    return states;
  }();
  expect_order(scene, GetParam(), 0.5, 1e-9, [&](const State& state, double t) {
    const State& exact = reference[static_cast<std::size_t>(std::lround(t / kCrossFrame))];
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) sum += distance_to(state, i, exact.x[i], exact.q[i]);
    return sum;
  });
}

// No external force acts: both momenta are conserved, and the energy to the order of the method.
TEST_P(CrossAndCylinder, KeepsTheMomentaOfFreeBodies) {
  const Scene scene = three_bodies(false);
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
    EXPECT_LT((end.angular - start.angular).norm(), 1.0 / std::pow(n, GetParam().order));
    last_drift = std::abs(report.energy - before.energy) / before.energy;
    if (n == 8) largest_drift = last_drift;
    EXPECT_LT(report.joint_gap, 2e-3);
  }
  const double shrinks = std::pow(2.0, GetParam().order);
  EXPECT_LT(last_drift, std::max(1e-9, 1.3 * largest_drift / shrinks)) << largest_drift;
}

TEST_P(CrossAndCylinder, ContinuesFromASceneFileBitForBit) {
  test::expect_continues(three_bodies(true), GetParam().settings);
}

// The order in which bodies and joints are listed changes only rounding.
TEST_P(CrossAndCylinder, IsTheSameInAnotherOrderOfTheFile) {
  const Scene scene = three_bodies(true);
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
  // Sweeps visit the joints in their order.
  const SolverKind solver = GetParam().settings.solver;
  const bool sweeps = solver == SolverKind::kPgs || solver == SolverKind::kXpbd;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((first.state().x[i] - second.state().x[2 - i]).norm(), sweeps ? 1e-3 : 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, CrossAndCylinder, testing::ValuesIn(joint_methods()),
                         [](const auto& method) { return method.param.name; });

/// A cube under a constant force and torque, its centre in the joint, after it has come to rest.
template <class Add>
Simulator yielding(const Vec3& force, const Vec3& torque, Add&& add) {
  SceneBuilder builder;
  const int box = builder.add_body(Box{{0.2, 0.2, 0.2}}, 1.0, Vec3::Zero());
  add(builder, box);
  builder.scene().gravity.setZero();
  builder.body(box).force = force;
  builder.body(box).torque = torque;
  Simulator simulator =
      test::simulator_of(*builder.build(), const_settings(SolverKind::kBpp, Integrator::kEuler, 4));
  for (int i = 0; i < 600; ++i) EXPECT_EQ(simulator.step().status, StepStatus::kOk);
  return simulator;
}

constexpr double kLinearC = 1e-3;
constexpr double kAngularC = 2e-3;

TEST(UniversalJoint, YieldsByItsCompliance) {
  const Vec3 force{2.0, 5.0, -3.0};
  const Simulator simulator = yielding(force, {0.0, 0.0, 4.0}, [](SceneBuilder& builder, int box) {
    const int cross =
        builder.add_universal(box, kWorld, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    auto& joint = std::get<UniversalJoint>(builder.scene().joints[index(cross)]);
    joint.compliance = kLinearC;
    joint.angular_compliance = kAngularC;
  });
  const State& state = simulator.state();
  EXPECT_LT((state.x[0] - kLinearC * force).norm(), 1e-7);
  // The row is a sine of the angle.
  EXPECT_LT((2.0 * state.q[0].vec() - kAngularC * Vec3(0.0, 0.0, 4.0)).norm(), 1e-5);
}

TEST(CylindricalJoint, YieldsByItsComplianceAcrossItsAxis) {
  const Vec3 force{0.0, 5.0, -3.0};
  const Vec3 torque{0.0, 2.0, -4.0};
  const Simulator simulator = yielding(force, torque, [](SceneBuilder& builder, int box) {
    const int slide = builder.add_cylindrical(box, kWorld, Vec3::Zero(), Vec3::UnitX());
    auto& joint = std::get<CylindricalJoint>(builder.scene().joints[index(slide)]);
    joint.compliance = kLinearC;
    joint.angular_compliance = kAngularC;
  });
  const State& state = simulator.state();
  EXPECT_LT((state.x[0] - kLinearC * force).norm(), 1e-7);
  EXPECT_LT((2.0 * state.q[0].vec() - kAngularC * torque).norm(), 1e-4);
}

// Turning about either pin, about the axis of the cylinder and sliding along it are no errors.
TEST(CrossAndCylinderStart, IsProjectedOntoWhatTheJointsHold) {
  Scene scene = three_bodies(true);
  const Scene closed = scene;
  scene.bodies[2].position += Vec3(0.3, 0.02, -0.03);
  scene.bodies[1].orientation = scene.bodies[1].orientation * Quat(1.0, 0.01, 0.02, -0.01);
  scene.bodies[1].orientation.normalize();
  scene.bodies[2].velocity += Vec3(1.0, 0.5, 0.0);
  EXPECT_FALSE(start_of_run(closed).report.projected);
  const Start start = start_of_run(scene);
  EXPECT_TRUE(start.report.projected);
  EXPECT_GT(start.report.found.gap, 0.02);
  EXPECT_GT(start.report.found.tilt, 0.01);
  EXPECT_LT(start.report.left.gap, 1e-12);
  EXPECT_LT(start.report.left.tilt, 1e-12);
  EXPECT_LT(start.report.left.speed, 1e-10);
  EXPECT_LT(start.report.left.turning, 1e-10);
}

}  // namespace
}  // namespace substep
