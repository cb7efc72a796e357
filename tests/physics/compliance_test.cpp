// A compliant joint obeys its own law, C lambda = -phi, for any N, dt, solver and drift law.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/names.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/run.hpp"

namespace substep {
namespace {

constexpr double kMass = 100.0;  // [kg]
using test::kAllSolvers;
using test::kGravity;

/// A weight on a compliant ball joint, at the joint's own point.
Scene weight_on_a_spring(double compliance) {
  Scene scene;
  scene.gravity = {0.0, -kGravity, 0.0};
  scene.effects.gravity = scene.effects.joints = true;
  Body body;
  body.name = "weight";
  body.shape = Sphere{0.1};
  body.mass = kMass;
  body.inertia = Vec3::Constant(0.4);
  body.collides = false;
  scene.bodies.push_back(body);
  BallJoint joint;
  joint.name = "spring";
  joint.compliance = compliance;
  scene.joints.emplace_back(joint);
  scene.criteria.joint_gap = 10.0;
  return scene;
}

Settings settings_of(SolverKind solver, int n, Integrator integrator, Drift drift) {
  PaperSettings settings;
  settings.solver = solver;
  settings.mode = Mode::kConst;
  settings.n = n;
  settings.integrator = integrator;
  settings.drift = drift;
  return settings;
}

}  // namespace

// Released at its equilibrium, the weight stays there. The soft law once multiplied the compliance
// by (tau/dt)^2: 603 mm at 64 sub-steps per frame.
TEST(Compliance, SagsEquallyAtAnyNumberOfSubsteps) {
  const double C = 1e-5;
  const double sag = C * kMass * kGravity;
  for (const SolverKind solver : kAllSolvers) {
    for (const Drift drift : {Drift::kFull, Drift::kSoft}) {
      for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
        for (const int n : {1, 8, 64, 256}) {
          Scene scene = weight_on_a_spring(C);
          scene.bodies[0].position.y() = -sag;
          const auto run =
              test::run(scene, settings_of(solver, n, integrator, drift), 2.0, {}, false);
          EXPECT_NEAR(-run.end.x[0].y(), sag, 0.005 * sag)
              << name_of(solver) << ", " << name_of(drift) << ", " << name_of(integrator) << ", n "
              << n;
        }
      }
    }
  }
}

TEST(Compliance, SwingsWithTheOrderOfTheIntegrator) {
  const double C = 1e-3;
  const double omega = 1.0 / std::sqrt(C * kMass);
  const double seconds = 2.0;
  const double exact = -C * kMass * kGravity * (1.0 - std::cos(omega * seconds));
  struct Method {
    SolverKind solver;
    Integrator integrator;
    Forces forces;
    Drift drift;
    double order;
  };
  const Method methods[] = {
      {SolverKind::kBpp, Integrator::kEuler, Forces::kEnd, Drift::kFull, 0.9},
      {SolverKind::kBpp, Integrator::kLeapfrog, Forces::kEnd, Drift::kFull, 1.9},
      {SolverKind::kBpp, Integrator::kLeapfrog, Forces::kEnd, Drift::kSoft, 1.9},
      {SolverKind::kPgs, Integrator::kLeapfrog, Forces::kEnd, Drift::kSoft, 1.9},
      {SolverKind::kXpbd, Integrator::kLeapfrog, Forces::kEnd, Drift::kFull, 1.9},
      {SolverKind::kNewton, Integrator::kLeapfrog, Forces::kMean, Drift::kFull, 1.9},
      {SolverKind::kNewton, Integrator::kLeapfrog, Forces::kNumerov, Drift::kFull, 1.9},
      {SolverKind::kBpp, Integrator::kStormer, Forces::kEnd, Drift::kFull, 3.6}};
  for (const Method& method : methods) {
    double error[2];
    for (int i = 0; i < 2; ++i) {
      Settings settings = settings_of(method.solver, 4 << i, method.integrator, method.drift);
      settings.forces = method.forces;
      const auto run = test::run(weight_on_a_spring(C), settings, seconds);
      error[i] = std::abs(run.end.x[0].y() - exact);
    }
    const std::string name =
        std::string(name_of(method.solver)) + ", " + std::string(name_of(method.integrator)) +
        ", " + std::string(name_of(method.forces)) + ", " + std::string(name_of(method.drift));
    if (error[1] < 1e-9) continue;
    EXPECT_GT(std::log2(error[0] / error[1]), method.order) << name;
  }
}

// The energy of a spring belongs to the energy, and its stretch is no gap: a weight on a spring
// holds without limits of the scene. Kinetic and potential energy alone change by all there is.
TEST(Compliance, TheEnergyIncludesThatOfSprings) {
  for (const double C : {1e-3, 1e-4}) {
    Scene scene = weight_on_a_spring(C);
    scene.criteria.joint_gap.reset();
    double most = 0.0;
    double alone = 0.0;
    double exchanged = 0.0;
    const test::EveryFrame every = [&](const Simulator&, const FrameReport& report) {
      EXPECT_EQ(report.energy, report.kinetic + report.potential + report.springs);
      EXPECT_EQ(report.elastic, report.springs);
      keep_largest(most, std::abs(report.energy));
      keep_largest(alone, std::abs(report.kinetic + report.potential));
      keep_largest(exchanged, report.kinetic);
    };
    const Settings settings =
        settings_of(SolverKind::kBpp, 16, Integrator::kLeapfrog, Drift::kFull);
    EXPECT_EQ(test::run(scene, settings, 3.0, every).verdict, "holds");
    EXPECT_LT(most, 0.01 * exchanged) << C;
    EXPECT_GT(alone, exchanged) << C;
  }
}

// A ball on a soft contact comes back: all of its energy is in the spring for a while.
TEST(Compliance, TheEnergyIncludesThatOfSoftContacts) {
  Scene scene;
  scene.effects.gravity = scene.effects.contact = true;
  scene.contact.compliance = 1e-3;
  Body ball;
  ball.name = "ball";
  ball.shape = Sphere{0.5};
  ball.mass = 1.0;
  ball.inertia = Vec3::Constant(0.1);
  ball.position.y() = 1.0;
  Body floor;
  floor.name = "floor";
  floor.is_static = true;
  floor.shape = Plane{};
  scene.bodies = {floor, ball};
  double springs = 0.0;
  const test::EveryFrame every = [&](const Simulator&, const FrameReport& report) {
    keep_largest(springs, report.springs);
  };
  const Settings settings = settings_of(SolverKind::kBpp, 64, Integrator::kLeapfrog, Drift::kFull);
  EXPECT_EQ(test::run(scene, settings, 3.0, every).verdict, "holds");
  EXPECT_GT(springs, 0.9 * kGravity * 0.5);
}

// Nothing grows, from resolved springs to unresolved ones.
TEST(Compliance, IsStableForEverySpring) {
  for (const Integrator integrator :
       {Integrator::kEuler, Integrator::kLeapfrog, Integrator::kStormer}) {
    for (double C = 1e-3; C > 1e-12; C *= 0.5) {
      for (const int n : {1, 3}) {
        const Scene scene = weight_on_a_spring(C);
        double lowest = 0.0;
        double highest = 0.0;
        test::run(scene, settings_of(SolverKind::kBpp, n, integrator, Drift::kFull), 5.0,
                  [&](const Simulator& simulator, const FrameReport&) {
                    lowest = std::min(lowest, simulator.state().x[0].y());
                    keep_largest(highest, simulator.state().x[0].y());
                  });
        const double sag = C * kMass * kGravity;
        const double dt = scene.frame / n;
        const double fall = 0.5 * kGravity * dt * dt;  // before an unresolved spring acts
        EXPECT_GT(lowest, -2.3 * sag - fall) << name_of(integrator) << " C " << C << " n " << n;
        EXPECT_LT(highest, 0.3 * sag + fall) << name_of(integrator) << " C " << C << " n " << n;
      }
    }
  }
}

namespace {

/// A ball of 0.1 kg that falls 1 m onto a ground of compliance 1 mm/N, without loss.
Scene ball_on_a_spring() {
  Scene scene;
  scene.frame = 0.02;
  scene.gravity = {0.0, -kGravity, 0.0};
  scene.effects.gravity = scene.effects.contact = true;
  scene.contact.compliance = 1e-3;
  Body ground;
  ground.name = "ground";
  ground.shape = Plane{};
  ground.is_static = true;
  scene.bodies.push_back(ground);
  Body ball;
  ball.name = "ball";
  ball.shape = Sphere{0.1};
  ball.mass = 0.1;
  ball.inertia = Vec3::Constant(0.0004);
  ball.position = {0.0, 1.1, 0.0};
  scene.bodies.push_back(ball);
  return scene;
}

/// Energy in flight relative to the start: its maximum and minimum in 10 s.
struct EnergyRange {
  double least = 1.0;
  double most = 1.0;
};
EnergyRange energy_in_flight(const Settings& settings) {
  EnergyRange range;
  test::run(ball_on_a_spring(), settings, 10.0,
            [&](const Simulator& simulator, const FrameReport&) {
              const State& state = simulator.state();
              const double gap = state.x[1].y() - 0.1;
              if (gap <= 0.0) return;
              const double v = state.u_synchronised[1][1];
              const double energy = (0.5 * v * v + kGravity * gap) / kGravity;
              range.least = std::min(range.least, energy);
              keep_largest(range.most, energy);
            });
  return range;
}

}  // namespace

// Implicit Euler removes three quarters of the energy in eleven bounces. A mean force that acted
// before the ball touched the ground would add some.
TEST(Compliance, AContactReturnsItsEnergy) {
  const auto lost = [](Settings settings) {
    double shares[2];
    for (int i = 0; i < 2; ++i) {
      settings.n = i == 0 ? 64 : 256;
      const EnergyRange range = energy_in_flight(settings);
      EXPECT_LT(range.most, 1.0 + 1e-12);
      shares[i] = 1.0 - range.least;
    }
    EXPECT_GT(std::log2(shares[0] / shares[1]) / 2.0, 1.9);
    return shares[0];
  };
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    EXPECT_LT(lost(settings_of(SolverKind::kBpp, 64, integrator, Drift::kFull)), 2e-3);
  }
  for (const Forces forces : {Forces::kMean, Forces::kNumerov}) {
    Settings newton = settings_of(SolverKind::kNewton, 64, Integrator::kLeapfrog, Drift::kFull);
    newton.forces = forces;
    EXPECT_LT(lost(newton), 6e-3);
  }
  const EnergyRange euler =
      energy_in_flight(settings_of(SolverKind::kBpp, 64, Integrator::kEuler, Drift::kFull));
  EXPECT_LT(euler.least, 0.3);
}

}  // namespace substep
