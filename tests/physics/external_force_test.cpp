// Constant forces and torques on bodies (effect `external`) against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "core/lab/closed_form.hpp"
#include "core/lab/planar_chain.hpp"
#include "core/math/turn.hpp"
#include "core/sim/conserved.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

constexpr double kRounding = 1e-12;  // of sums over some hundred sub-steps, on numbers of order 10

Body body_of(const Shape& shape, double mass) {
  Body body;
  body.shape = shape;
  body.mass = mass;
  body.inertia = solid_inertia(shape, mass);
  return body;
}

/// One free box, pushed and twisted.
Scene pushed(const Vec3& force, const Vec3& torque) {
  Scene scene;
  scene.effects = {.external = true};
  scene.bodies = {body_of(Box{{0.4, 0.15, 0.3}}, 2.5)};
  scene.bodies[0].velocity = {1.0, -2.0, 0.5};
  scene.bodies[0].force = force;
  scene.bodies[0].torque = torque;
  return scene;
}

Settings fixed(Integrator integrator, int n) {
  return {.mode = Mode::kConst, .n = n, .integrator = integrator};
}

TEST(ExternalForce, MovesTheCentreOnItsParabola) {
  const Vec3 force{3.0, 4.0, -1.0};
  for (const bool gravity : {false, true}) {
    Scene scene = pushed(force, Vec3::Zero());
    scene.effects.gravity = gravity;
    const Vec3 a = force / 2.5 + (gravity ? scene.gravity : Vec3(Vec3::Zero()));
    for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
      for (const int n : {1, 3, 8}) {
        Simulator simulator = simulator_of(scene, fixed(integrator, n));
        for (int frame = 0; frame < 60; ++frame) simulator.step();
        const State& state = simulator.state();
        const double t = state.time;
        const Vec3 v = scene.bodies[0].velocity;
        EXPECT_LT((state.x[0] - v * t - 0.5 * t * t * a).norm(), kRounding) << n;
        EXPECT_LT((state.u_synchronised[0].head<3>() - v - t * a).norm(), kRounding) << n;
        EXPECT_EQ(Vec3(state.u[0].tail<3>()), Vec3(Vec3::Zero())) << "it acts at the centre";
      }
    }
  }
}

TEST(ExternalForce, KeepsKineticAndPotentialEnergy) {
  Scene scene = pushed({3.0, 4.0, -1.0}, Vec3::Zero());
  scene.effects.gravity = true;
  Simulator simulator = simulator_of(scene, fixed(Integrator::kLeapfrog, 2));
  const FrameReport start = simulator.observe();
  FrameReport report;
  for (int frame = 0; frame < 120; ++frame) report = simulator.step();
  EXPECT_GT(std::abs(report.kinetic - start.kinetic), 10.0);
  EXPECT_NEAR(report.energy, start.energy, 1e-11);
  const Body& body = scene.bodies[0];
  EXPECT_NEAR(report.potential,
              -(body.force + body.mass * scene.gravity).dot(simulator.state().x[0]), 1e-11);
}

TEST(ExternalForce, TorqueAboutAPrincipalAxisSpinsUpLinearly) {
  const Quat q(Eigen::AngleAxisd(0.8, Vec3(1.0, 2.0, 2.0) / 3.0));
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = q * Vec3::Unit(axis);
    Scene scene = pushed(Vec3::Zero(), 0.3 * along);
    scene.effects.gyroscopic = true;
    scene.bodies[0].orientation = q;
    const double alpha = 0.3 / scene.bodies[0].inertia[axis];  // [rad/s^2]
    double error[2];
    for (const int fine : {0, 1}) {
      Simulator simulator = simulator_of(scene, fixed(Integrator::kLeapfrog, fine == 0 ? 4 : 8));
      for (int frame = 0; frame < 30; ++frame) simulator.step();
      const State& state = simulator.state();
      const double t = state.time;
      EXPECT_LT((state.u_synchronised[0].tail<3>() - alpha * t * along).norm(), 1e-10) << axis;
      const Quat exact = Quat(Eigen::AngleAxisd(0.5 * alpha * t * t, along)) * q;
      error[fine] = exact.angularDistance(state.q[0]);
    }
    // The Cayley map takes dt omega for 2 tan(angle/2): second order.
    EXPECT_NEAR(error[0] / error[1], 4.0, 0.1) << axis;
  }
}

TEST(ExternalForce, TorqueIsTheRateOfAngularMomentum) {
  const Vec3 torque{0.2, -0.1, 0.4};
  Scene scene = pushed(Vec3::Zero(), torque);
  scene.effects.gyroscopic = true;
  scene.bodies[0].angular_velocity = {3.0, 1.0, -2.0};
  double error[2];
  for (const int fine : {0, 1}) {
    Simulator simulator = simulator_of(scene, fixed(Integrator::kLeapfrog, fine == 0 ? 32 : 64));
    const Vec3 start = momenta_of(scene, simulator.state()).angular;
    for (int frame = 0; frame < 60; ++frame) simulator.step();
    const Momenta end = momenta_of(scene, simulator.state());
    error[fine] = (end.angular - start - simulator.state().time * torque).norm();
  }
  for (const double e : error) EXPECT_LT(e, 1e-12) << "momentum is what torques change, exactly";
}

TEST(ExternalForce, HoldsAPendulumAsideWithEverySolver) {
  // Pulled by F = (3, 0, 4) in addition to its weight, a rod on a ball joint rests along F + m g.
  for (const SolverKind solver :
       {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kNewton, SolverKind::kXpbd}) {
    Scene scene;
    scene.effects = {.gravity = true, .joints = true, .external = true};
    Body rod = body_of(Box{{0.1, 0.5, 0.1}}, 2.0);
    rod.force = {3.0, 0.0, 4.0};
    const Vec3 pull = rod.force + rod.mass * scene.gravity;
    rod.orientation = turn_between(Vec3(0.0, -1.0, 0.0), pull);
    rod.position = 0.5 * pull.normalized();
    scene.bodies = {rod};
    BallJoint joint;
    joint.name = "pivot";
    joint.anchor_a = {0.0, 0.5, 0.0};
    scene.joints = {joint};
    Settings settings = fixed(Integrator::kEuler, 4);
    settings.solver = solver;
    Simulator simulator = simulator_of(scene, settings);
    for (int frame = 0; frame < 60; ++frame) simulator.step();
    EXPECT_LT((simulator.state().x[0] - rod.position).norm(), 1e-9) << static_cast<int>(solver);
    EXPECT_LT((simulator.constraint_forces().joints[0].force + pull).norm(), 1e-6 * pull.norm())
        << static_cast<int>(solver);
  }
}

TEST(ExternalForce, HasNoStageUnlessItIsListed) {
  Scene scene = pushed({3.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  EXPECT_TRUE(simulator_of(scene, {}).step().stages.external);
  scene.effects.external = false;
  Simulator simulator = simulator_of(scene, fixed(Integrator::kEuler, 2));
  const FrameReport report = simulator.step();
  EXPECT_FALSE(report.stages.external);
  EXPECT_EQ(report.potential, 0.0);
  EXPECT_EQ(Vec3(simulator.state().u[0].head<3>()), scene.bodies[0].velocity);
}

TEST(ExternalForce, IsIncludedInThePredictionOfContacts) {
  // At rest 0.3 m above a thin plate, and pushed down with 4,000 m/s^2: 0.55 m in a frame.
  for (const Detection detection : {Detection::kSubstep, Detection::kFrame}) {
    Scene scene;
    scene.effects = {.contact = true, .external = true};
    Body ball = body_of(Sphere{0.1}, 1.0);
    ball.position = {0.0, 0.41, 0.0};
    ball.force = {0.0, -4000.0, 0.0};
    Body plate;
    plate.shape = Box{{1.0, 0.01, 1.0}};
    plate.is_static = true;
    scene.bodies = {ball, plate};
    Settings settings = fixed(Integrator::kEuler, 1);
    settings.detection = detection;
    Simulator simulator = simulator_of(scene, settings);
    simulator.step();
    EXPECT_EQ(simulator.state().x[0].y() > 0.1, detection == Detection::kFrame);
  }
}

TEST(ExternalForce, IsInTheClosedFormsOrThereAreNone) {
  Scene scene = pushed({5.0, 0.0, 0.0}, Vec3::Zero());
  scene.effects.gravity = true;
  scene.criteria.track = 0;
  ASSERT_TRUE(closed_form(scene));
  EXPECT_LT((closed_form(scene)->acceleration - Vec3(2.0, -9.81, 0.0)).norm(), 1e-15);
  scene.bodies[0].torque = {0.0, 1.0, 0.0};
  EXPECT_FALSE(closed_form(scene)) << "the energy of its spin changes";

  Scene slope = scenes::sliding_box();
  ASSERT_TRUE(closed_form(slope));
  slope.effects.external = true;
  for (Body& body : slope.bodies) {
    if (!body.is_static) body.force = {1.0, 0.0, 0.0};
  }
  EXPECT_FALSE(closed_form(slope));

  Scene chain = scenes::pendulum();
  EXPECT_TRUE(PlanarChain::of(chain));
  chain.effects.external = true;
  EXPECT_FALSE(PlanarChain::of(chain));
}

}  // namespace
}  // namespace substep::test
