// Limits and motors of hinges and slides, against closed forms, quadrature and conservation laws.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/lab/exact_motion.hpp"
#include "core/lab/verdict.hpp"
#include "core/math/angle.hpp"
#include "core/math/turn.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/conserved.hpp"
#include "tests/support/joint_methods.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

constexpr double kRodFrame = 1.0 / 60.0;  // [s]
constexpr double kRodMass = 1.0;          // [kg]
constexpr double kRodArm = 0.5;           // from the hinge to the centre [m]

/// A rod that hangs from the world by a hinge at its end, level at the start.
SceneBuilder rod(double speed, bool falls) {
  SceneBuilder builder("rod");
  const int body = builder.add_body(Box{{kRodArm, 0.05, 0.05}}, kRodMass, {kRodArm, 0.0, 0.0});
  builder.add_hinge(body, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.body(body).angular_velocity = {0.0, 0.0, speed};
  builder.body(body).velocity = {0.0, kRodArm * speed, 0.0};
  builder.scene().frame = kRodFrame;
  if (!falls) builder.scene().gravity.setZero();
  return builder;
}

double moment_about_hinge(const Scene& scene) {
  return scene.bodies[0].inertia.z() + kRodMass * kRodArm * kRodArm;
}

double angle_of_rod(const State& state) { return 2.0 * angle_of(state.q[0].z(), state.q[0].w()); }

/// Angle and speed of a rod without gravity between -1 and 1, e > 0.
double bouncing_angle(double speed, double e, double t) {
  double angle = 0.0;
  for (double rate = speed; rate != 0.0; rate *= -e) {
    const double until = ((rate > 0.0 ? 1.0 : -1.0) - angle) / rate;
    if (until >= t) return angle + t * rate;
    angle += until * rate;
    t -= until;
  }
  return angle;
}

double error_of_bounces(double e, const Settings& settings) {
  SceneBuilder builder = rod(3.0, false);
  builder.limit(0, -1.0, 1.0, e);
  return error_after(*builder.build(), settings, 1.5, [&](const State& state, double t) {
    return std::abs(angle_of_rod(state) - bouncing_angle(3.0, e, t));
  });
}

// The rotation of a sub-step is a Cayley map: an error of (dt omega)^2/12 of the angle.
TEST(Limits, ARodReboundsAsTheCoefficientSays) {
  for (const Integrator integrator :
       {Integrator::kEuler, Integrator::kLeapfrog, Integrator::kStormer}) {
    for (const int n : {0, 1, 2, 4, 16, 64}) {
      for (const double e : {0.0, 0.5, 1.0}) {
        Settings settings = steady_at(n);
        settings.integrator = integrator;
        const double turn = 3.0 * kRodFrame / std::max(n, 1);
        EXPECT_LT(error_of_bounces(e, settings), 4.5 * turn * turn / 4.0 + 1e-5)
            << n << " " << e << " " << static_cast<int>(integrator);
      }
    }
  }
}

// Solvers that hold constraints at the end of a sub-step stop a rod there: first order.
TEST(Limits, ReboundOfEverySolverConverges) {
  for (const SolverKind solver : kAllSolvers) {
    for (const bool old : {false, true}) {
      double last = 0.0;
      for (const int n : {8, 32, 128}) {
        Settings settings = old ? const_settings(solver, Integrator::kEuler, n) : steady_at(n);
        settings.solver = solver;
        settings.iterations = 400;
        const double error = error_of_bounces(0.5, settings);
        const double most = last == 0.0 ? 1.0 : std::max(0.4 * last, 3e-4);
        EXPECT_LT(error, most) << static_cast<int>(solver) << " n " << n;
        last = error;
      }
      EXPECT_LT(last, 0.01) << static_cast<int>(solver);
    }
  }
}

/// The travel of a body that falls from rest down a rail with the acceleration a and rebounds from
/// the bound at L.
double bouncing_travel(double a, double L, double e, double t) {
  const double fall = std::sqrt(2.0 * L / a);
  if (t <= fall) return 0.5 * a * t * t;
  t -= fall;
  for (double speed = e * a * fall; speed > 1e-6; speed *= e) {
    const double flight = 2.0 * speed / a;
    if (t <= flight) return L - speed * t + 0.5 * a * t * t;
    t -= flight;
  }
  return L;
}

/// The angle of a falling rod that meets its lower bound -1: Runge-Kutta of fourth order, with the
/// time of each impact bisected.
class FallingRod {
 public:
  FallingRod(double moment, double e) : pull_(kRodMass * kGravity * kRodArm / moment), e_(e) {}
  void advance_to(double end) {
    constexpr double kStep = 1e-4;
    while (time_ < end - 1e-12) {
      const double dt = std::min(kStep, end - time_);
      Phase next = after(dt);
      double taken = dt;
      if (next.angle < -1.0) {
        double late = dt;
        taken = 0.0;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (taken + late);
          (after(middle).angle < -1.0 ? late : taken) = middle;
        }
        next = {-1.0, -e_ * after(taken).rate};
      }
      now_ = next;
      time_ += taken;
    }
  }
  [[nodiscard]] double angle() const { return now_.angle; }

 private:
  struct Phase {
    double angle;
    double rate;
  };
  [[nodiscard]] Phase after(double dt) const {
    const auto slope = [&](const Phase& at) { return Phase{at.rate, -pull_ * std::cos(at.angle)}; };
    const auto along = [&](const Phase& k, double t) {
      return Phase{now_.angle + t * k.angle, now_.rate + t * k.rate};
    };
    const Phase k1 = slope(now_);
    const Phase k2 = slope(along(k1, 0.5 * dt));
    const Phase k3 = slope(along(k2, 0.5 * dt));
    const Phase k4 = slope(along(k3, dt));
    return {now_.angle + dt / 6.0 * (k1.angle + 2.0 * (k2.angle + k3.angle) + k4.angle),
            now_.rate + dt / 6.0 * (k1.rate + 2.0 * (k2.rate + k3.rate) + k4.rate)};
  }

  double pull_;
  double e_;
  double time_ = 0.0;
  Phase now_{0.0, 0.0};
};

TEST(Limits, AFallingRodFollowsTheQuadratureThroughItsRebounds) {
  for (const double e : {0.5, 1.0}) {
    SceneBuilder builder = rod(0.0, true);
    builder.limit(0, -1.0, 1.0, e);
    const Scene scene = *builder.build();
    for (const int n : {4, 16, 64}) {
      FallingRod exact(moment_about_hinge(scene), e);
      const double error = error_after(scene, steady_at(n), 1.0, [&](const State& state, double t) {
        exact.advance_to(t);
        return std::abs(angle_of_rod(state) - exact.angle());
      });
      EXPECT_LT(error, 2e-3 * 16.0 / (n * n) + 1e-5) << n << " " << e;
    }
  }
}

// The torque on the closed limit of a rod at rest is that of its weight.
TEST(Limits, AClosedLimitHoldsTheRod) {
  SceneBuilder builder = rod(0.0, true);
  builder.limit(0, 0.0, 1.0);
  const Scene scene = *builder.build();
  for (const SolverKind solver : kAllSolvers) {
    for (const bool old : {false, true}) {
      Settings settings = old ? const_settings(solver, Integrator::kEuler, 4) : steady_at(4);
      settings.solver = solver;
      settings.iterations = 400;
      Simulator simulator = simulator_of(scene, settings);
      for (int i = 0; i < 120; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const std::string name = std::to_string(static_cast<int>(solver)) + (old ? " old" : "");
      EXPECT_NEAR(angle_of_rod(simulator.state()), 0.0, 1e-6) << name;
      const double torque = simulator.constraint_forces().joints[0].torque.z();
      EXPECT_NEAR(torque, kRodMass * kGravity * kRodArm, 1e-3 * kRodMass * kGravity * kRodArm)
          << name;
    }
  }
}

TEST(Limits, NRisesWhenOneCloses) {
  // A link that swings out on a rotating one is stopped by its limit.
  SceneBuilder builder("links");
  const Vec3 half{0.25, 0.03, 0.03};
  const int first = builder.add_body(Box{half}, 1.0, {0.25, 0.0, 0.0});
  const int second = builder.add_body(Box{half}, 1.0, {0.5, 0.25, 0.0});
  builder.body(second).orientation = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  builder.add_hinge(first, kWorld, Vec3::Zero(), Vec3::UnitZ());
  const int elbow = builder.add_hinge(second, first, {0.5, 0.0, 0.0}, Vec3::UnitZ());
  builder.limit(elbow, -0.5, 0.5);
  for (const int body : {first, second}) {
    builder.body(body).collides = false;
    builder.body(body).angular_velocity = {0.0, 0.0, 15.0};
    builder.body(body).velocity = Vec3(0.0, 0.0, 15.0).cross(builder.body(body).position);
  }
  builder.scene().gravity.setZero();
  Simulator simulator(builder.build());
  const int open = simulator.step().n_substeps;
  int closed = 0;
  for (int i = 0; i < 20; ++i) closed = std::max(closed, simulator.step().n_substeps);
  EXPECT_GT(closed, open);
}

TEST(Limits, AnOpenOneCostsNothing) {
  SceneBuilder free = rod(0.0, true);
  SceneBuilder limited = rod(0.0, true);
  limited.limit(0, -3.5, 2.0, 0.5);
  for (const int n : {0, 4}) {
    Simulator without = simulator_of(*free.build(), steady_at(n));
    Simulator with = simulator_of(*limited.build(), steady_at(n));
    for (int i = 0; i < 120; ++i) {
      const FrameReport a = without.step();
      const FrameReport b = with.step();
      ASSERT_EQ(a.n_substeps, b.n_substeps);
      ASSERT_EQ(a.work.flops, b.work.flops);
      ASSERT_EQ(a.joint_rows, b.joint_rows);
      ASSERT_EQ(state_hash(without.state()), state_hash(with.state())) << i;
    }
  }
}

// Two free bodies in space, of unequal moments.
TEST(Limits, KeepTheMomentumOfAFreePairAndItsEnergyWithEOne) {
  SceneBuilder builder("pair");
  const Vec3 axis = Vec3(0.3, 1.0, -0.4).normalized();
  const int a = builder.add_body(Box{{0.3, 0.1, 0.05}}, 2.0, {0.3, 0.05, 0.0});
  const int b = builder.add_body(Box{{0.1, 0.25, 0.15}}, 1.0, {-0.2, 0.1, 0.1});
  const int hinge = builder.add_hinge(a, b, Vec3::Zero(), axis);
  builder.limit(hinge, -0.7, 0.4, 1.0);
  const Vec3 spin{1.0, -0.5, 2.0};
  for (const int body : {a, b}) {
    builder.body(body).collides = false;
    builder.body(body).angular_velocity = body == a ? Vec3(spin + 4.0 * axis) : spin;
    builder.body(body).velocity =
        builder.body(body).angular_velocity.cross(builder.body(body).position);
  }
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  for (const int n : {0, 8, 32}) {
    Simulator simulator = simulator_of(scene, steady_at(n));
    const Momenta start = momenta_of(scene, simulator.state());
    const double energy = energies_of(scene, simulator.state()).sum();
    double changed = 0.0;
    bool rebounded = false;
    for (int i = 0; i < 180; ++i) {
      const FrameReport report = simulator.step();
      ASSERT_EQ(report.status, StepStatus::kOk);
      rebounded = rebounded || report.work.impacts > 0;
      keep_largest(changed, std::abs(report.energy - energy));
    }
    EXPECT_TRUE(rebounded);
    const Momenta end = momenta_of(scene, simulator.state());
    EXPECT_LT((end.linear - start.linear).norm(), 1e-12) << n;
    // To rounding where sub-steps end at impacts; one that closes within a sub-step is of its
    // order.
    EXPECT_LT((end.angular - start.angular).norm(), n == 32 ? 1e-13 : 5e-4) << n;
    EXPECT_LT(changed, 0.02 * energy) << n;
  }
}

/// A random linkage of one to five bodies with limits, in a plane or in space.
Scene random_linkage(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
  };
  const auto one_of = [&](unsigned n) { return static_cast<int>(random() % n); };
  SceneBuilder builder("linkage");
  const int bodies = 1 + one_of(5);
  const bool hangs = one_of(2) == 0;
  const bool falls = one_of(2) == 0;
  const bool planar = one_of(2) == 0;
  const auto vector = [&](double size) {
    const double x = uniform(-size, size);
    const double y = uniform(-size, size);
    const double z = uniform(-size, size);
    return Vec3(x, y, planar ? 0.0 : z);
  };
  const auto turning = [&](double size) {
    const Vec3 all = vector(size);
    return planar ? Vec3(0.0, 0.0, all.x()) : all;
  };
  const Vec3 spin = turning(3.0);
  Vec3 at = Vec3::Zero();
  int last = kWorld;
  for (int i = 0; i < bodies; ++i) {
    const double half = uniform(0.05, 0.3);
    const double height = uniform(0.03, 0.1);
    const double depth = uniform(0.03, 0.1);
    const Vec3 along = vector(1.0).normalized();
    const Vec3 centre = at + 1.1 * half * along;
    const double mass = std::exp(uniform(-3.0, 3.0));
    const int body = builder.add_body(Box{{half, height, depth}}, mass, centre);
    builder.body(body).orientation = turn_between(Vec3::UnitX(), along);
    builder.body(body).collides = false;
    if (i > 0 || hangs) {
      const Vec3 axis = planar ? Vec3(Vec3::UnitZ()) : vector(1.0);
      const int hinge = builder.add_hinge(body, last, at, axis);
      if (one_of(4) > 0) {
        const double lower = -uniform(0.02, 2.5);
        const double upper = uniform(0.02, 2.5);
        builder.limit(hinge, lower, upper, one_of(2) == 0 ? 0.0 : uniform(0.0, 1.0));
      }
    }
    builder.body(body).angular_velocity = spin;
    builder.body(body).velocity = spin.cross(centre);
    last = body;
    at = centre + 1.1 * half * along;
  }
  builder.body(last).angular_velocity += turning(8.0);
  if (!falls) builder.scene().gravity.setZero();
  return *builder.build();
}

/// How far beyond its bounds a hinge is [rad].
double beyond(const HingeJoint& hinge, const State& state) {
  const auto q = [&](int body) {
    return body == kWorld ? Quat(Quat::Identity()) : state.q[index(body)];
  };
  const AngleLimit& limit = *hinge.limit;
  const double angle = angle_about(q(hinge.a) * hinge.axis_a, q(hinge.b) * limit.across_b,
                                   q(hinge.a) * limit.across_a);
  const double middle = 0.5 * (limit.lower + limit.upper);
  return std::abs(wrapped(angle - middle)) - 0.5 * (limit.upper - limit.lower);
}

// Adaptive, default settings.
TEST(Limits, OfRandomLinkagesHoldAndGiveNoEnergy) {
  constexpr unsigned kScenes = 120;
  for (unsigned seed = 0; seed < kScenes; ++seed) {
    const Scene scene = random_linkage(seed);
    Simulator simulator = simulator_of(scene, steady());
    const FrameReport start = simulator.observe();
    Verdict verdict(scene, simulator.state(), start);
    double lowest = start.energy;
    double rise = 0.0;
    double kinetic = start.kinetic;
    for (int i = 0; i < 180; ++i) {
      const FrameReport report = simulator.step();
      verdict.add(scene, simulator.state(), report);
      lowest = std::min(lowest, report.energy);
      keep_largest(rise, report.energy - lowest);
      keep_largest(kinetic, report.kinetic);
      for (const Joint& joint : scene.joints) {
        if (limit_of(joint) == nullptr) continue;
        ASSERT_LT(beyond(std::get<HingeJoint>(joint), simulator.state()), 1e-4) << seed;
      }
    }
    EXPECT_TRUE(verdict.holds()) << seed << " " << verdict.text();
    EXPECT_LT(rise, 0.02 * kinetic) << seed;
  }
}

// The moments about the other axes do not matter, nor does what pushes the rod: gravity, a torque,
// or a motor at its largest torque, which is a torque.
TEST(Limits, ThinRodsRebound) {
  constexpr double kRestitution = 0.8;
  for (const double half : {0.3, 0.05, 0.01, 0.005}) {
    for (const int n : {0, 1, 4, 64}) {
      for (const bool driven : {false, true}) {
        SceneBuilder builder("rod");
        const int body =
            builder.add_body(Box{{kRodArm, half, half}}, kRodMass, {kRodArm, 0.0, 0.0});
        const int hinge = builder.add_hinge(body, kWorld, Vec3::Zero(), Vec3::UnitZ());
        builder.limit(hinge, -1.0, 0.5, kRestitution);
        builder.scene().gravity.setZero();
        if (driven) {
          builder.drive(hinge, 100.0, 1.0);
        } else {
          builder.body(body).torque = Vec3::UnitZ();
        }
        const Scene scene = *builder.build();
        const double a = 1.0 / moment_about_hinge(scene);
        const double error =
            error_after(scene, steady_at(n), 0.9, [&](const State& state, double t) {
              return std::abs(angle_of_rod(state) - bouncing_travel(a, 0.5, kRestitution, t));
            });
        EXPECT_LT(error, 1e-3) << half << " " << n << (driven ? " motor" : " torque");
      }
    }
  }
}

// A link that a motor or its bounds hold still is at rest: it is not struck in every sub-step.
TEST(Limits, WhatRestsOnThemIsNotStruck) {
  for (const bool narrow : {false, true}) {
    for (const Integrator integrator :
         {Integrator::kEuler, Integrator::kLeapfrog, Integrator::kStormer}) {
      SceneBuilder builder("links");
      const Vec3 half{0.25, 0.03, 0.03};
      const int first = builder.add_body(Box{half}, 1.0, {0.25, 0.0, 0.0});
      const int second = builder.add_body(Box{half}, 1.0, {0.75, 0.0, 0.0});
      builder.body(first).collides = builder.body(second).collides = false;
      const int shoulder = builder.add_hinge(first, kWorld, Vec3::Zero(), Vec3::UnitZ());
      const int elbow = builder.add_hinge(second, first, {0.5, 0.0, 0.0}, Vec3::UnitZ());
      builder.drive(elbow, 60.0, 1.0);
      builder.limit(shoulder, narrow ? -1e-4 : -0.01, narrow ? 1e-4 : 0.01);
      if (!narrow) builder.drive(shoulder, 5.0, 200.0);
      builder.scene().gravity.setZero();
      const Scene scene = *builder.build();
      Settings settings = steady_at(8);
      settings.integrator = integrator;
      Simulator simulator = simulator_of(scene, settings);
      std::int64_t impacts = 0;
      for (int i = 0; i < 60; ++i) impacts += simulator.step().work.impacts;
      const double moment = scene.bodies[1].inertia.z() + 0.25 * 0.25;
      EXPECT_NEAR(simulator.state().u_synchronised[1].tail<3>().z(), 1.0 / moment, 0.1 / moment)
          << narrow << " " << static_cast<int>(integrator);
      EXPECT_LT(impacts, 60) << narrow << " " << static_cast<int>(integrator);
    }
  }
}

// A grab pulls a rod against a limit that is found on the way: each row keeps its own softness.
TEST(Limits, HoldARodThatIsPulled) {
  for (const SolverKind solver : kAllSolvers) {
    SceneBuilder builder = rod(0.0, false);
    builder.limit(0, -1.0, 0.3);
    Settings settings = steady_at(4);
    settings.solver = solver;
    Simulator simulator = simulator_of(*builder.build(), settings);
    Grab grab;
    grab.body = 0;
    grab.anchor = {kRodArm, 0.0, 0.0};
    grab.target = {0.0, 1.0, 0.0};
    grab.mass = kRodMass;
    simulator.set_grab(grab);
    for (int i = 0; i < 60; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_NEAR(angle_of_rod(simulator.state()), 0.3, 1e-3) << static_cast<int>(solver);
    EXPECT_LT(simulator.state().u[0].norm(), 0.01) << static_cast<int>(solver);
  }
}

TEST(Motors, DoNotFallAsleep) {
  SceneBuilder builder = rod(0.0, false);
  builder.drive(0, 0.001, 1.0);
  Settings settings = steady();
  settings.sleep = true;
  Simulator simulator = simulator_of(*builder.build(), settings);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(simulator.step().asleep, 0);
  EXPECT_NEAR(angle_of_rod(simulator.state()), 0.005, 1e-4);
}

// With a largest torque T on the moment I: T t/I until the velocity is reached.
TEST(Motors, RampUpAtTheirLargestTorque) {
  constexpr double kTorque = 0.5;
  constexpr double kVelocity = 2.0;
  SceneBuilder builder = rod(0.0, false);
  builder.drive(0, kVelocity, kTorque);
  const Scene scene = *builder.build();
  const double rate = kTorque / moment_about_hinge(scene);
  for (const JointMethod& method : joint_methods()) {
    const double error =
        error_after(scene, method.settings, 1.0, [&](const State& state, double t) {
          return std::abs(angle_of_rod(state) - 0.5 * rate * t * t);
        });
    // Euler's velocities are half a sub-step late.
    EXPECT_LT(error, method.order == 1 ? 1.1 * 0.5 * rate * kRodFrame / 8.0 : 1e-4) << method.name;
    Simulator simulator = simulator_of(scene, method.settings);
    for (int i = 0; i < 120; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_NEAR(simulator.state().u[0].tail<3>().z(), kVelocity, 2e-3) << method.name;
    EXPECT_LT(std::abs(simulator.constraint_forces().joints[0].torque.z()), 0.02) << method.name;
  }
}

// A motor of velocity 0 is a brake: the speed falls by T t/I, whatever its direction.
TEST(Motors, BrakeInBothDirections) {
  constexpr double kTorque = 0.5;
  for (const double speed : {-3.0, 3.0}) {
    SceneBuilder builder = rod(speed, false);
    builder.drive(0, 0.0, kTorque);
    const Scene scene = *builder.build();
    const double slower = kTorque / moment_about_hinge(scene) * (speed > 0.0 ? -1.0 : 1.0);
    for (const JointMethod& method : joint_methods()) {
      const double error =
          error_after(scene, method.settings, 0.5, [&](const State& state, double t) {
            return std::abs(wrapped(angle_of_rod(state) - speed * t - 0.5 * slower * t * t));
          });
      EXPECT_LT(error, method.order == 1 ? 0.01 : 1e-3) << method.name << " " << speed;
    }
  }
}

TEST(Motors, StallUnderALoadThatIsTooLarge) {
  const double load = kRodMass * kGravity * kRodArm;
  for (const JointMethod& method : joint_methods()) {
    for (const bool holds : {false, true}) {
      SceneBuilder builder = rod(0.0, true);
      builder.drive(0, 0.0, (holds ? 1.2 : 0.8) * load);
      const Scene scene = *builder.build();
      Simulator simulator = simulator_of(scene, method.settings);
      for (int i = 0; i < 30; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const double torque = simulator.constraint_forces().joints[0].torque.z();
      const double angle = angle_of_rod(simulator.state());
      if (holds) {
        EXPECT_NEAR(angle, 0.0, 1e-6) << method.name;
        EXPECT_NEAR(torque, load, 0.01 * load) << method.name;
      } else {
        // It falls with 0.2 of its weight at first.
        const double slow = -0.5 * 0.2 * load / moment_about_hinge(scene) * 0.25;
        EXPECT_NEAR(angle, slow, 0.1 * std::abs(slow)) << method.name;
        EXPECT_NEAR(torque, 0.8 * load, 1e-9 * load) << method.name;
      }
    }
  }
}

// An offset centre and a rail in space: the joint carries a moment.
TEST(Limits, ASlideReboundsAsTheCoefficientSays) {
  const Vec3 rail = Vec3(4.0, -6.0, 3.0).normalized();
  const double a = -kGravity * rail.y();
  for (const auto& [e, turns] :
       {std::pair{0.0, false}, {0.5, false}, {1.0, false}, {0.0, true}, {0.5, true}, {1.0, true}}) {
    SceneBuilder builder("slide");
    // On a cylindrical joint it turns about the rail at a constant rate.
    const int box =
        builder.add_body(Box{{0.2, 0.1, 0.3}}, 3.0, turns ? Vec3(0.4 * rail) : Vec3(0.3, 0.2, 0.4));
    builder.body(box).orientation = turns ? turn_between(Vec3::UnitZ(), rail) : Quat(1, 0, 0, 0);
    if (turns) builder.body(box).angular_velocity = 3.0 * rail;
    const int slide = turns ? builder.add_cylindrical(box, kWorld, Vec3::Zero(), rail)
                            : builder.add_prismatic(box, kWorld, Vec3::Zero(), rail);
    builder.limit(slide, -5.0, 0.7, e);
    const Scene scene = *builder.build();
    const Vec3 start = scene.bodies[0].position;
    for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
      for (const int n : {0, 1, 4, 16, 64}) {
        Settings settings = steady_at(n);
        settings.integrator = integrator;
        const double error = error_after(scene, settings, 2.0, [&](const State& state, double t) {
          return (state.x[0] - start - bouncing_travel(a, 0.7, e, t) * rail).norm();
        });
        // A rebound that returns within a sub-step rests; one of e = 1 loses 1e-7 of its speed.
        const double dt = scene.frame / std::max(n, 1);
        EXPECT_LT(error, (e == 0.5 ? 2.0 * a * dt * dt : 0.0) + 2e-5) << n << " " << e;
      }
    }
  }
}

/// A ball at an end of a rope, the other end of which is in the origin.
Scene ball_on_a_rope(const Vec3& at, double length, double e, const Vec3& velocity = Vec3::Zero()) {
  SceneBuilder builder("ball");
  const int ball = builder.add_body(Sphere{0.05}, 2.0, at);
  builder.body(ball).velocity = velocity;
  builder.add_rope(ball, kWorld, at, Vec3::Zero(), length, e);
  builder.scene().title = "Ball";
  return *builder.build();
}

TEST(Rope, ABallFallsFreelyAndReboundsWhereItIsTaut) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const Scene scene = ball_on_a_rope({0.0, -0.1, 0.0}, 0.8, e);
    for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
      for (const int n : {0, 1, 4, 16, 64}) {
        Settings settings = steady_at(n);
        settings.integrator = integrator;
        const double error = error_after(scene, settings, 2.0, [&](const State& state, double t) {
          const double y = -0.1 - bouncing_travel(kGravity, 0.7, e, t);
          return (state.x[0] - Vec3(0.0, y, 0.0)).norm();
        });
        const double dt = scene.frame / std::max(n, 1);
        EXPECT_LT(error, (e == 0.5 ? 2.0 * kGravity * dt * dt : 0.0) + 2e-5) << n << " " << e;
      }
    }
  }
}

// With every solver: the force is that of a rod, and the rope is no longer than it may be.
TEST(Rope, ATautOneIsAPendulumAndCarriesItsWeight) {
  constexpr double kStart = std::numbers::pi / 3.0;
  constexpr double kLength = 0.8;
  const ExactPendulum exact = ExactPendulum::released(std::sqrt(kGravity / kLength), kStart);
  const auto at = [&](double angle) -> Vec3 {
    return kLength * Vec3(std::sin(angle), -std::cos(angle), 0.0);
  };
  for (const JointMethod& method : joint_methods()) {
    Settings settings = method.settings;
    settings.n = 32;
    const auto error = [&](const State& state, double t) {
      return (state.x[0] - at(exact.at(t).angle)).norm();
    };
    const double off = error_after(ball_on_a_rope(at(kStart), kLength, 0.0), settings, 1.5, error);
    EXPECT_LT(off, method.order == 1 ? 5e-3 : 2e-4) << method.name;
    Simulator hanging = simulator_of(ball_on_a_rope(at(0.0), kLength, 0.0), settings);
    for (int i = 0; i < 30; ++i) ASSERT_EQ(hanging.step().status, StepStatus::kOk);
    const JointForce force = hanging.constraint_forces().joints.at(0);
    EXPECT_TRUE(force.known);
    EXPECT_NEAR(force.force.y(), 2.0 * kGravity, 1e-3) << method.name;
  }
}

// Thrown level, it flies freely until the rope is taut, loses its speed along the rope, and gains
// no energy in the swing after it.
TEST(Rope, AThrownBallLosesItsSpeedAlongIt) {
  const Vec3 start{0.0, -0.2, 0.0};
  const Vec3 thrown{2.0, 0.0, 0.0};
  constexpr double kLength = 1.0;
  const auto flight = [&](double t) -> Vec3 {
    return start + t * thrown - 0.5 * kGravity * t * t * Vec3::UnitY();
  };
  double taut = 0.0;
  double late = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (taut + late);
    (flight(middle).norm() < kLength ? taut : late) = middle;
  }
  const Vec3 velocity = thrown - kGravity * taut * Vec3::UnitY();
  const double lost = std::pow(velocity.dot(flight(taut)) / kLength, 2);  // of 2 kg [J]
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    Settings settings = steady_at(16);
    settings.integrator = integrator;
    const Scene scene = ball_on_a_rope(start, kLength, 0.0, thrown);
    Simulator simulator = simulator_of(scene, settings);
    const double before = simulator.observe().energy;
    for (int i = 0; i < 120; ++i) {
      const FrameReport report = simulator.step();
      ASSERT_EQ(report.status, StepStatus::kOk);
      const double t = simulator.state().time;
      if (t < taut) {
        EXPECT_LT((simulator.state().x[0] - flight(t)).norm(), 1e-10);
        EXPECT_NEAR(report.energy, before, 1e-9);
      } else if (t > taut + scene.frame) {
        EXPECT_NEAR(report.energy, before - lost, 0.01 * lost) << t;
        EXPECT_LT(simulator.state().x[0].norm(), kLength + 1e-4);
      }
    }
  }
}

// Two bodies of unequal moments, off their centres: the rope ends their flight apart.
TEST(Rope, TwoFreeBodiesKeepTheirMomentum) {
  for (const double e : {0.0, 0.6}) {
    SceneBuilder builder("pair");
    const int a = builder.add_body(Box{{0.1, 0.05, 0.2}}, 1.0, {0.3, 0.1, 0.0});
    const int b = builder.add_body(Box{{0.05, 0.2, 0.1}}, 3.0, {-0.3, 0.0, 0.1});
    builder.body(a).velocity = {3.0, 0.5, 0.0};
    builder.body(b).velocity = {-1.0, 0.0, 0.2};
    builder.body(b).angular_velocity = {0.5, -0.3, 0.4};
    builder.add_rope(a, b, {0.35, 0.12, 0.05}, {-0.3, 0.1, 0.1}, 0.9, e);
    builder.scene().gravity.setZero();
    const Scene scene = *builder.build();
    Simulator simulator = simulator_of(scene, steady_at(8));
    const Momenta start = momenta_of(scene, simulator.state());
    const double before = simulator.observe().energy;
    FrameReport report;
    for (int i = 0; i < 60; ++i) report = simulator.step();
    EXPECT_LT((momenta_of(scene, simulator.state()).linear - start.linear).norm(), 1e-12);
    EXPECT_LT(report.energy, 0.95 * before);
    EXPECT_GT(report.energy, 0.05 * before);
    const auto& rope = std::get<RopeJoint>(scene.joints[0]);
    const State& end = simulator.state();
    const Vec3 apart = end.x[0] + end.q[0] * rope.anchor_a - end.x[1] - end.q[1] * rope.anchor_b;
    EXPECT_LT(apart.norm(), 0.9 + 1e-3);
  }
}

TEST(Rope, ContinuesFromASceneFileBitForBit) {
  for (const JointMethod& method : joint_methods()) {
    expect_continues(ball_on_a_rope({0.2, -0.3, 0.0}, 0.5, 0.4), method.settings);
  }
}

TEST(Motors, PushASlideWithTheirLargestForce) {
  constexpr double kForce = 6.0;
  constexpr double kVelocity = 1.5;
  for (const bool turns : {false, true})
    for (const JointMethod& method : joint_methods()) {
      SceneBuilder builder("slide");
      const int box = builder.add_body(Box{{0.2, 0.1, 0.3}}, 3.0,
                                       turns ? Vec3(0.3, 0.0, 0.0) : Vec3(0.3, 0.2, 0.4));
      if (turns) builder.body(box).angular_velocity = {4.0, 0.0, 0.0};
      const int slide = turns ? builder.add_cylindrical(box, kWorld, Vec3::Zero(), Vec3::UnitX())
                              : builder.add_prismatic(box, kWorld, Vec3::Zero(), Vec3::UnitX());
      builder.drive(slide, kVelocity, kForce);
      const Scene scene = *builder.build();
      const double error =
          error_after(scene, method.settings, 0.7, [&](const State& state, double t) {
            return std::abs(state.x[0].x() - 0.3 - 0.5 * kForce / 3.0 * t * t);
          });
      EXPECT_LT(error, method.order == 1 ? 0.7 * kForce / 3.0 * kRodFrame / 8.0 : 1e-4)
          << method.name;
      Simulator simulator = simulator_of(scene, method.settings);
      for (int i = 0; i < 60; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      EXPECT_NEAR(simulator.state().u[0].x(), kVelocity, 1e-6) << method.name;
    }
}

// A motor drives a rod into its limit, which carries its whole torque.
TEST(Motors, PressAgainstALimit) {
  SceneBuilder builder = rod(0.0, false);
  builder.limit(0, -1.0, 1.0);
  builder.drive(0, 5.0, 3.0);
  const Scene scene = *builder.build();
  for (const SolverKind solver : kAllSolvers) {
    Settings settings = steady_at(4);
    settings.solver = solver;
    settings.iterations = 400;
    Simulator simulator = simulator_of(scene, settings);
    for (int i = 0; i < 120; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_NEAR(angle_of_rod(simulator.state()), 1.0, 1e-4) << static_cast<int>(solver);
    EXPECT_NEAR(simulator.constraint_forces().joints[0].torque.z(), 0.0, 0.05);
  }
}

TEST(LimitsAndMotors, ARunContinuesBitForBitFromAFile) {
  SceneBuilder builder("arm");
  int last = kWorld;
  for (int i = 0; i < 3; ++i) {
    const int body = builder.add_body(Box{{0.25, 0.04, 0.03}}, 1.0, {0.25 + 0.5 * i, 0.0, 0.0});
    builder.body(body).collides = false;
    const int hinge = builder.add_hinge(body, last, {0.5 * i, 0.0, 0.0}, Vec3::UnitZ());
    builder.limit(hinge, -0.4, 0.6, 0.3);
    builder.drive(hinge, 2.0, 1.5);
    last = body;
  }
  for (const int n : {0, 4}) {
    Simulator whole = simulator_of(*builder.build(), steady_at(n));
    for (int i = 0; i < 45; ++i) whole.step();
    const Scene saved = saved_scene(whole.scene(), whole.state(), whole.settings());
    const SceneResult read = read_scene(write_scene(saved));
    for (const Problem& problem : read.problems) ADD_FAILURE() << to_string(problem);
    ASSERT_TRUE(read.scene);
    Simulator rest(read.scene);
    for (int i = 0; i < 60; ++i) {
      whole.step();
      rest.step();
      ASSERT_EQ(whole.state().x, rest.state().x) << n << " " << i;
      ASSERT_EQ(whole.state().u, rest.state().u) << n << " " << i;
    }
  }
}

}  // namespace
}  // namespace substep::test
