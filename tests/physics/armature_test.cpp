// Armatures of hinges and slides: against closed forms, minimal coordinates, and in impacts.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/lab/joint_tree.hpp"
#include "core/lab/verdict.hpp"
#include "core/math/across.hpp"
#include "core/math/angle.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/conserved.hpp"
#include "tests/support/joint_methods.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"
#include "tests/support/two_rods.hpp"

namespace substep::test {
namespace {

constexpr double kArmatureFrame = 1.0 / 60.0;  // [s]

/// A rod of 1 kg and 1 m on a hinge at its end with an armature, level.
SceneBuilder geared(double armature, double speed = 0.0) {
  SceneBuilder builder("geared");
  const int body = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
  builder.add_armature(builder.add_hinge(body, kWorld, Vec3::Zero(), Vec3::UnitZ()), armature);
  builder.body(body).angular_velocity = {0.0, 0.0, speed};
  builder.body(body).velocity = {0.0, 0.5 * speed, 0.0};
  builder.scene().frame = kArmatureFrame;
  return builder;
}

double moment_of_rod(const Scene& scene) { return scene.bodies[0].inertia.z() + 0.25; }

double angle_in_plane(const Quat& q) { return 2.0 * angle_of(q.z(), q.w()); }

using Slope = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Runge and Kutta's method of fourth order.
void advance(const Slope& slope, double seconds, int steps, Eigen::VectorXd& y) {
  const double h = seconds / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::VectorXd k1 = slope(y);
    const Eigen::VectorXd k2 = slope(y + 0.5 * h * k1);
    const Eigen::VectorXd k3 = slope(y + 0.5 * h * k2);
    const Eigen::VectorXd k4 = slope(y + h * k3);
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
}

// (I + a) theta'' = -m g d cos(theta), from level: first order with Euler, second with all others.
TEST(Armature, SlowsAPendulum) {
  for (const double armature : {0.05, 3.0}) {
    const Scene scene = *geared(armature).build();
    const double pull = kGravity * 0.5 / (moment_of_rod(scene) + armature);
    const Slope slope = [&](const Eigen::VectorXd& y) {
      return Eigen::Vector2d(y[1], -pull * std::cos(y[0]));
    };
    for (const JointMethod& method : joint_methods()) {
      SCOPED_TRACE(method.name);
      Eigen::VectorXd exact = Eigen::VectorXd::Zero(2);
      double at = 0.0;
      const JointMethod as{method.name, method.settings, std::min(method.order, 2)};
      expect_order(scene, as, 1.0, 1e-10, [&](const State& state, double t) {
        if (t < at) {
          exact.setZero();
          at = 0.0;
        }
        advance(slope, t - at, 50, exact);
        at = t;
        return std::abs(angle_in_plane(state.q[0]) - exact[0]);
      });
    }
  }
}

// Its energy is part of the kinetic energy.
TEST(Armature, KeepsTheEnergyOfAPendulum) {
  const Scene scene = *geared(0.7).build();
  for (const JointMethod& method : joint_methods()) {
    Settings settings = method.settings;
    settings.n = 16;
    Simulator simulator = simulator_of(scene, settings);
    const double start = energies_of(scene, simulator.state()).sum();
    for (int i = 0; i < 120; ++i) {
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const double rate = simulator.state().u_synchronised[0][5];
      const Energies now = energies_of(scene, simulator.state());
      EXPECT_NEAR(now.kinetic, 0.5 * (moment_of_rod(scene) + 0.7) * rate * rate,
                  5e-5 * now.kinetic + 1e-9);
      EXPECT_NEAR(now.sum(), start, method.order == 1 ? 0.08 : 2e-3) << method.name << " " << i;
    }
  }
}

// A motor that has not reached its speed: T/(I + a), but for the error of a turning arm. Velocities
// of Euler are those of the end of a sub-step.
TEST(Armature, SlowsTheRampOfAMotor) {
  for (const double armature : {1e-3, 1.0, 1e4}) {
    SceneBuilder builder = geared(armature);
    builder.drive(0, 1e4, 2.0);
    builder.scene().gravity.setZero();
    const Scene scene = *builder.build();
    const double rate = 2.0 / (moment_of_rod(scene) + armature);
    for (const JointMethod& method : joint_methods()) {
      const double error =
          error_after(scene, method.settings, 0.5, [&](const State& state, double t) {
            const Vec6& u = method.order == 1 ? state.u[0] : state.u_synchronised[0];
            return std::abs(u[5] - rate * t);
          });
      EXPECT_LT(error, (method.order == 1 ? 2e-3 : 1e-4) * rate) << method.name << " " << armature;
    }
  }
}

// sqrt(k/(I + a)), with an armature of which the rod's moment is a small part: a drive that looked
// at the bodies alone would be damped as one that is too stiff for the sub-step.
TEST(Armature, SlowsTheOscillationOfADrive) {
  constexpr double kStiffness = 2.3e5;
  constexpr double kArmature = 5.8e3;
  SceneBuilder builder = geared(kArmature);
  builder.drive(0, {.target = 0.3, .stiffness = kStiffness});
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  const double w = std::sqrt(kStiffness / (moment_of_rod(scene) + kArmature));
  for (const JointMethod& method : joint_methods()) {
    const JointMethod as{method.name, method.settings, std::min(method.order, 2)};
    SCOPED_TRACE(method.name);
    expect_order(scene, as, 2.0, 1e-8, [&](const State& state, double t) {
      return std::abs(angle_in_plane(state.q[0]) - 0.3 * (1.0 - std::cos(w * t)));
    });
    const double error =
        error_after(scene, method.settings, 2.0, [&](const State& state, double t) {
          return std::abs(angle_in_plane(state.q[0]) - 0.3 * (1.0 - std::cos(w * t)));
        });
    EXPECT_LT(error, method.order == 1 ? 0.05 : 5e-4) << method.name;
  }
}

// Two free bodies on a hinge through their centres: T/(1/(1/I_a + 1/I_b) + a), and no momentum.
TEST(Armature, ReducesTheAccelerationOfTwoFreeBodies) {
  SceneBuilder builder("two");
  const int a = builder.add_body(Box{{0.5, 0.1, 0.2}}, 2.0, {0.0, 0.0, 0.0});
  const int b = builder.add_body(Box{{0.2, 0.4, 0.1}}, 3.0, {0.0, 0.0, 0.5});
  const int hinge = builder.add_hinge(a, b, {0.0, 0.0, 0.2}, Vec3::UnitZ());
  builder.add_armature(hinge, 0.4);
  builder.drive(hinge, 1e4, 1.5);
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  const double of_a = scene.bodies[0].inertia.z();
  const double of_b = scene.bodies[1].inertia.z();
  const double rate = 1.5 / (1.0 / (1.0 / of_a + 1.0 / of_b) + 0.4);
  for (const JointMethod& method : joint_methods()) {
    Simulator simulator = simulator_of(scene, method.settings);
    for (int i = 0; i < 30; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    const State& state = simulator.state();
    const double t = state.time;
    const std::vector<Vec6>& u = method.order == 1 ? state.u : state.u_synchronised;
    EXPECT_NEAR(u[0][5] - u[1][5], rate * t, 1e-6 * rate * t) << method.name;
    EXPECT_LT(momenta_of(scene, state).angular.norm(), 1e-7) << method.name;
  }
}

// A bead with an armature on a rod that turns freely, r the bead's distance:
//   (m + a) r'' = m r w^2,   (I + m r^2) w = const.
// Without dJ/dt in the rate the order would be 1.
TEST(Armature, OfASlideThatTurns) {
  constexpr double kArmature = 2.0;
  constexpr double kSpin = 2.0;
  SceneBuilder builder("bead");
  const int rod = builder.add_body(Box{{0.6, 0.05, 0.05}}, 2.0, {0.0, 0.0, 0.0});
  builder.body(rod).collides = false;
  const int bead = builder.add_body(Sphere{0.05}, 1.0, {0.2, 0.0, 0.0});
  builder.add_hinge(rod, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_armature(builder.add_prismatic(bead, rod, {0.2, 0.0, 0.0}, Vec3::UnitX()), kArmature);
  builder.body(rod).angular_velocity = builder.body(bead).angular_velocity = {0.0, 0.0, kSpin};
  builder.body(bead).velocity = {0.0, 0.2 * kSpin, 0.0};
  builder.scene().gravity.setZero();
  builder.scene().frame = kArmatureFrame;
  const Scene scene = *builder.build();
  const double moment = scene.bodies[0].inertia.z() + scene.bodies[1].inertia.z();
  const double momentum = (moment + 0.04) * kSpin;
  const Slope slope = [&](const Eigen::VectorXd& y) {
    const double w = momentum / (moment + y[0] * y[0]);
    return Eigen::Vector3d(y[1], y[0] * w * w / (1.0 + kArmature), w);
  };
  for (const JointMethod& method : joint_methods()) {
    SCOPED_TRACE(method.name);
    Eigen::VectorXd exact = Eigen::Vector3d(0.2, 0.0, 0.0);
    double at = 0.0;
    const JointMethod as{method.name, method.settings, std::min(method.order, 2)};
    expect_order(scene, as, 1.0, 1e-9, [&](const State& state, double t) {
      if (t < at) {
        exact = Eigen::Vector3d(0.2, 0.0, 0.0);
        at = 0.0;
      }
      advance(slope, t - at, 50, exact);
      at = t;
      return (state.x[1] - exact[0] * Vec3(std::cos(exact[2]), std::sin(exact[2]), 0.0)).norm();
    });
  }
}

/// An arm of three links in space with armatures that exceed the moments of the links.
Scene geared_arm(double share = 1.0) {
  SceneBuilder builder("arm");
  const Vec3 axes[] = {{0.2, 1.0, 0.1}, {0.3, -0.2, 1.0}, {1.0, 0.4, 0.3}};
  int last = kWorld;
  for (int i = 0; i < 3; ++i) {
    const int link = builder.add_body(Box{{0.2, 0.04, 0.06}}, 1.0 - 0.2 * i, {0.2 + 0.4 * i, 0, 0});
    const int hinge = builder.add_hinge(link, last, {0.4 * i, 0.0, 0.0}, axes[i]);
    if (share > 0.0) builder.add_armature(hinge, share * (0.3 - 0.1 * i));
    last = link;
  }
  builder.scene().frame = kArmatureFrame;
  const Vec3 spin = 3.0 * Vec3(axes[0]).normalized();
  for (int i = 0; i < 3; ++i) {
    builder.body(i).collides = false;
    builder.body(i).angular_velocity = spin;
    builder.body(i).velocity = spin.cross(builder.body(i).position);
  }
  return *builder.build();
}

// Against Featherstone's articulated bodies in minimal coordinates, D = h . A h + a.
TEST(Armature, OfAnArmInSpaceIsThatOfMinimalCoordinates) {
  const Scene scene = geared_arm();
  for (const JointMethod& method : joint_methods()) {
    SCOPED_TRACE(method.name);
    const JointMethod as{method.name, method.settings, std::min(method.order, 2)};
    std::optional<JointTree> exact;
    double at = 0.0;
    expect_order(scene, as, 0.5, 1e-9, [&](const State& state, double t) {
      if (!exact || t < at) {
        exact = JointTree::of(scene);
        at = 0.0;
      }
      exact->advance(t - at);
      at = t;
      double error = 0.0;
      for (int i = 0; i < 3; ++i) error += (state.x[index(i)] - exact->centre(i)).norm();
      return error;
    });
  }
}

// The reference itself, in a plane: M + diag(a) of two rods.
TEST(Armature, OfMinimalCoordinatesIsAddedToTheMassMatrix) {
  SceneBuilder builder("two rods");
  int last = kWorld;
  for (int i = 0; i < 2; ++i) {
    const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0 + i, {0.5 + i, 0.0, 0.0});
    builder.body(rod).collides = false;
    builder.add_armature(builder.add_hinge(rod, last, {1.0 * i, 0.0, 0.0}, Vec3::UnitZ()),
                         0.2 + 0.3 * i);
    last = rod;
  }
  const Scene scene = *builder.build();
  // Angles theta_1 and, relative to it, theta_2; at rest, level.
  const Eigen::Matrix2d M = inertia_of_two_rods(scene);
  const Eigen::Vector2d pull(-kGravity * (0.5 + 2.0 * 1.5), -kGravity * 2.0 * 0.5);
  const Eigen::Vector2d acceleration = M.inverse() * pull;
  std::optional<JointTree> tree = JointTree::of(scene);
  ASSERT_TRUE(tree);
  constexpr double kShort = 1e-4;
  tree->advance(kShort);
  EXPECT_NEAR(tree->velocity(0)[5], acceleration[0] * kShort, 1e-10);
  EXPECT_NEAR(tree->velocity(1)[5], acceleration.sum() * kShort, 1e-10);
  // Its energy: what gravity gave.
  tree->advance(0.3);
  const double fallen = -kGravity * (tree->centre(0).y() + 2.0 * tree->centre(1).y());
  EXPECT_NEAR(tree->kinetic(), fallen, 1e-9 * fallen);
}

// With the default settings, N decided by the scene, over 20 s; resolved, it keeps its energy.
TEST(Armature, OfAnArmGainsNoEnergyByDefault) {
  for (const double share : {0.1, 1.0, 100.0}) {
    const Scene scene = geared_arm(share);
    for (const int n : {0, 32}) {
      Simulator simulator = simulator_of(scene, steady_at(n));
      const double start = energies_of(scene, simulator.state()).sum();
      double kinetic = 0.0;
      double most = 0.0;
      double least = 0.0;
      for (int i = 0; i < 1200; ++i) {
        ASSERT_EQ(simulator.step().status, StepStatus::kOk);
        const Energies now = energies_of(scene, simulator.state());
        kinetic = std::max(kinetic, now.kinetic);
        most = std::max(most, now.sum() - start);
        least = std::min(least, now.sum() - start);
      }
      EXPECT_LT(most, 0.01 * kinetic) << share;
      EXPECT_TRUE(n == 0 || least > -1e-3 * kinetic) << share << " " << least;
    }
  }
}

// Light links in a row that pull a heavy one: the torques of the joints turn with the links,
// against their armatures, which exceed the moments of the links a hundred times.
TEST(Armature, IsInTheReportedEnergyOfLightLinksUnderTension) {
  SceneBuilder builder("row");
  builder.scene().gravity.setZero();
  int last = kWorld;
  Vec3 v = Vec3::Zero();  // of the last joint
  for (int i = 0; i < 6; ++i) {
    const bool is_last = i == 5;
    const int link =
        builder.add_body(Box{{0.2, 0.05, 0.05}}, is_last ? 1000.0 : 1.0, {0.2 + 0.4 * i, 0, 0});
    builder.body(link).collides = false;
    builder.add_armature(builder.add_hinge(link, last, {0.4 * i, 0, 0}, Vec3::UnitZ()), 2.0);
    const double rate = is_last ? -v.y() / 0.2 : i % 2 == 0 ? -3.0 : 3.0;
    builder.body(link).angular_velocity = {0.0, 0.0, rate};
    builder.body(link).velocity = v + Vec3(0.0, 0.2 * rate, 0.0);
    v += Vec3(0.0, 0.4 * rate, 0.0);
    last = link;
  }
  const Scene scene = *builder.build();
  for (const JointMethod& method : joint_methods()) {
    Settings settings = method.settings;
    settings.n = 64;
    Simulator simulator = simulator_of(scene, settings);
    const double start = energies_of(scene, simulator.state()).kinetic;
    for (int i = 0; i < 30; ++i) {
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const double kinetic = energies_of(scene, simulator.state()).kinetic;
      EXPECT_NEAR(kinetic, start, (method.order == 1 ? 0.02 : 2e-3) * start) << method.name;
    }
  }
}

// Free bodies keep their momenta: an armature exerts opposite torques.
TEST(Armature, OfFreeBodiesKeepsTheirMomenta) {
  SceneBuilder builder("free");
  const int a = builder.add_body(Box{{0.5, 0.1, 0.2}}, 2.0, {0.0, 0.0, 0.0});
  const int b = builder.add_body(Box{{0.2, 0.4, 0.1}}, 3.0, {0.7, 0.0, 0.0});
  builder.add_armature(builder.add_hinge(a, b, {0.5, 0.0, 0.0}, {0.1, 0.3, 1.0}), 0.4);
  builder.body(a).angular_velocity = {0.3, 2.0, 0.7};
  builder.body(a).collides = false;
  builder.scene().gravity.setZero();
  builder.scene().start = StartPolicy::kProject;
  const Scene scene = *builder.build();
  Settings settings = const_settings(SolverKind::kBpp, Integrator::kLeapfrog, 8);
  Simulator simulator = simulator_of(scene, settings);
  const Momenta start = momenta_of(scene, simulator.state());
  const double energy = energies_of(scene, simulator.state()).sum();
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    const Momenta now = momenta_of(scene, simulator.state());
    EXPECT_LT((now.linear - start.linear).norm(), 1e-9);
    EXPECT_LT((now.angular - start.angular).norm(), 1e-4 * start.angular.norm());
  }
  EXPECT_NEAR(energies_of(scene, simulator.state()).sum(), energy, 1e-3 * energy);
}

// Two rods in a line meet the limit of the first hinge: the impulse P of the limit gives
// (M + diag(a)) (q+ - q-) = (P, 0), with q1+ = -e q1-.
TEST(Armature, TakesPartInImpacts) {
  for (const double e : {0.0, 0.6}) {
    for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
      for (const Detection detection : {Detection::kContinuous, Detection::kSubstep}) {
        constexpr double kRate = 2.0;
        constexpr double kBend = 0.5;  // rate of the second hinge
        SceneBuilder builder("two rods");
        int last = kWorld;
        for (int i = 0; i < 2; ++i) {
          const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0 + i, {0.5 + i, 0.0, 0.0});
          builder.body(rod).collides = false;
          const int hinge = builder.add_hinge(rod, last, {1.0 * i, 0.0, 0.0}, Vec3::UnitZ());
          builder.add_armature(hinge, 0.2 + 0.3 * i);
          if (i == 0) builder.limit(hinge, -1.0, 1e-4, e);
          builder.body(rod).angular_velocity = {0.0, 0.0, kRate + kBend * i};
          last = rod;
        }
        builder.body(0).velocity = {0.0, 0.5 * kRate, 0.0};
        builder.body(1).velocity = {0.0, kRate + 0.5 * (kRate + kBend), 0.0};
        builder.scene().gravity.setZero();
        builder.scene().frame = 1e-3;
        const Scene scene = *builder.build();
        const Eigen::Matrix2d M = inertia_of_two_rods(scene);
        const Eigen::Matrix2d inverse = M.inverse();
        const double first = -e * kRate;
        const double second = kBend - (1.0 + e) * kRate * inverse(1, 0) / inverse(0, 0);
        Settings settings = steady_at(8);
        settings.integrator = integrator;
        settings.detection = detection;
        Simulator simulator = simulator_of(scene, settings);
        for (int i = 0; i < 2; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
        const State& state = simulator.state();
        const std::string name = std::to_string(e) + " " +
                                 std::to_string(static_cast<int>(integrator)) + " " +
                                 std::to_string(static_cast<int>(detection));
        EXPECT_NEAR(state.u_synchronised[0][5], first, 0.01) << name;
        EXPECT_NEAR(state.u_synchronised[1][5] - state.u_synchronised[0][5], second, 0.01) << name;
      }
    }
  }
}

// Two rods in a line whose hinges both are at their limits: impacts one after the other.
TEST(Armature, TakesPartInImpactsThatSpread) {
  constexpr double kRate = 2.0;
  constexpr double kElastic = 0.6;
  SceneBuilder builder("two rods");
  int last = kWorld;
  for (int i = 0; i < 2; ++i) {
    const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0 + i, {0.5 + i, 0.0, 0.0});
    builder.body(rod).collides = false;
    const int hinge = builder.add_hinge(rod, last, {1.0 * i, 0.0, 0.0}, Vec3::UnitZ());
    builder.add_armature(hinge, 0.2 + 0.3 * i);
    builder.limit(hinge, -1.0, 1e-9, kElastic);
    builder.body(rod).angular_velocity = {0.0, 0.0, kRate};
    last = rod;
  }
  builder.body(0).velocity = {0.0, 0.5 * kRate, 0.0};
  builder.body(1).velocity = {0.0, 1.5 * kRate, 0.0};
  builder.scene().gravity.setZero();
  builder.scene().frame = 1e-3;
  const Scene scene = *builder.build();
  const Eigen::Matrix2d M = inertia_of_two_rods(scene);
  const Eigen::Matrix2d inverse = M.inverse();
  Eigen::Vector2d rate(kRate, 0.0);
  for (int i = 0; rate.maxCoeff() > 1e-6; ++i) {
    const int at = rate[0] > 1e-6 ? 0 : 1;
    rate -= (1.0 + kElastic) * rate[at] / inverse(at, at) * inverse.col(at);
    ASSERT_LT(i, 100);
  }
  for (const Detection detection : {Detection::kContinuous, Detection::kSubstep}) {
    Settings settings = steady_at(8);
    settings.detection = detection;
    Simulator simulator = simulator_of(scene, settings);
    for (int i = 0; i < 2; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    const State& state = simulator.state();
    const int of = static_cast<int>(detection);
    EXPECT_NEAR(state.u_synchronised[0][5], rate[0], 0.01) << of;
    EXPECT_NEAR(state.u_synchronised[1][5] - state.u_synchronised[0][5], rate[1], 0.01) << of;
  }
}

// A ball without weight hits a rod at its end: p = (1 + e) v/(1/m + L^2/(I + a)).
TEST(Armature, IsFeltByWhatHitsAJointedBody) {
  for (const double armature : {0.5, 50.0}) {
    SceneBuilder builder = geared(armature);
    const int ball = builder.add_body(Sphere{0.1}, 0.5, {0.9, 0.16, 0.0});
    builder.body(ball).velocity = {0.0, -3.0, 0.0};
    builder.body(ball).restitution = 0.7;
    builder.scene().gravity.setZero();
    const Scene scene = *builder.build();
    const double inertia = moment_of_rod(scene) + armature;
    const double p = 1.7 * 3.0 / (1.0 / 0.5 + 0.81 / inertia);
    for (const Detection detection : {Detection::kContinuous, Detection::kSubstep}) {
      Settings settings = steady_at(16);
      settings.detection = detection;
      Simulator simulator = simulator_of(scene, settings);
      for (int i = 0; i < 6; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      EXPECT_NEAR(simulator.state().u[1][1], -3.0 + p / 0.5, 0.02) << armature;
      EXPECT_NEAR(simulator.state().u[0][5], -p * 0.9 / inertia, 0.02) << armature;
      const double kinetic = 0.5 * 0.5 * std::pow(-3.0 + p / 0.5, 2) + 0.5 * p * p * 0.81 / inertia;
      EXPECT_NEAR(energies_of(scene, simulator.state()).kinetic, kinetic, 0.02) << armature;
    }
  }
}

// Thin links with large armatures rebound from a limit against a drive, and rest on it.
TEST(Armature, OfThinLinksAtALimit) {
  SceneBuilder builder("finger");
  const int link = builder.add_body(Box{{0.02, 0.002, 0.002}}, 1e-3, {0.02, 0.0, 0.0});
  const int hinge = builder.add_hinge(link, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_armature(hinge, 0.01);
  builder.limit(hinge, -1.0, 0.2, 0.5);
  builder.drive(hinge, {.target = 1.0, .stiffness = 1.0});
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  const double inertia = scene.bodies[0].inertia.z() + 1e-3 * 4e-4 + 0.01;
  for (const int n : {4, 16}) {
    Simulator simulator = simulator_of(scene, steady_at(n));
    double most = 0.0;
    double fastest_back = 0.0;
    for (int i = 0; i < 600; ++i) {
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      keep_largest(most, angle_in_plane(simulator.state().q[0]));
      fastest_back = std::min(fastest_back, simulator.state().u_synchronised[0][5]);
    }
    // q'^2 = k (1 - 0.8^2)/(I + a) when it arrives.
    EXPECT_NEAR(fastest_back, -0.5 * std::sqrt(0.36 / inertia), 0.3);
    EXPECT_LT(most, 0.2 + 1e-3);
    EXPECT_NEAR(angle_in_plane(simulator.state().q[0]), 0.2, 1e-3);
    EXPECT_NEAR(simulator.state().u[0][5], 0.0, 1e-3);
  }
}

TEST(Armature, ContinuesFromASavedScene) {
  Scene scene = geared_arm();
  auto& hinge = std::get<HingeJoint>(scene.joints[1]);
  Vec3 v1;
  Vec3 v2;
  across(hinge.axis_a, v1, v2);
  hinge.drive = AngularDrive{{.target = 1.0, .stiffness = 5.0, .damping = 0.1}, {v1, v1}};
  scene.effects.drives = true;
  for (const JointMethod& method : joint_methods()) {
    SCOPED_TRACE(method.name);
    expect_continues(scene, method.settings);
  }
  expect_continues(scene, steady_at(0));
  expect_continues(scene, PaperSettings{});
}

// A frame that is taken again, and islands with their own sub-steps, carry the rate too.
TEST(Armature, IsCarriedThroughFramesTakenAgain) {
  for (const bool islands : {false, true}) {
    Scene scene = beside({geared_arm(), transformed(geared_arm(), Quat::Identity(), {5, 0, 0})});
    scene.effects.armature = true;
    Settings settings = steady_at(0);
    settings.redo = true;
    settings.islands = islands;
    settings.alpha = 0.05;
    Simulator simulator = simulator_of(scene, settings);
    std::optional<JointTree> exact = JointTree::of(geared_arm());
    for (int i = 0; i < 30; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    exact->advance(simulator.state().time);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT((simulator.state().x[index(i)] - exact->centre(i)).norm(), 1e-3);
      EXPECT_LT((simulator.state().x[index(i + 3)] - exact->centre(i) - Vec3(5, 0, 0)).norm(),
                1e-3);
    }
  }
}

// In other units the motion is the same.
TEST(Armature, HasNoUnitOfItsOwn) {
  const Scene scene = geared_arm();
  const Scene other = in_units(scene, 1e-3, 10.0, 0.1);
  Simulator one = simulator_of(scene, steady_at(8));
  Settings settings = steady_at(8);
  settings.drift_tau *= 0.1;
  Simulator two = simulator_of(other, settings);
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(one.step().status, StepStatus::kOk);
    ASSERT_EQ(two.step().status, StepStatus::kOk);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((10.0 * one.state().x[i] - two.state().x[i]).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace substep::test
