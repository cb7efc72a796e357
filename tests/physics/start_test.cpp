// Starts that contradict their joints: measured, projected by the smallest change, kept or refused.

#include "core/sim/start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/lab/experiment.hpp"
#include "core/lab/start_text.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/start_projection.hpp"
#include "scenes/generator/hard_set.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

Body box_at(const Vec3& x, const Vec3& half, double mass, const Quat& q = Quat::Identity()) {
  Body body;
  body.name = "box";
  body.shape = Box{half};
  body.mass = mass;
  body.inertia = solid_inertia(body.shape, mass);
  body.position = x;
  body.orientation = q;
  return body;
}

template <class JointType>
JointType between(int a, const Vec3& anchor_a, int b, const Vec3& anchor_b) {
  JointType joint;
  joint.name = "joint_" + std::to_string(a);
  joint.a = a;
  joint.b = b;
  joint.anchor_a = anchor_a;
  joint.anchor_b = anchor_b;
  return joint;
}

/// Three free boxes of unequal moments, arbitrarily rotated, on a ball joint and a hinge that are
/// open, tilted and moving apart.
Scene scattered() {
  Scene scene;
  scene.effects = {.gyroscopic = true, .joints = true};
  const Quat q(Eigen::AngleAxisd(0.4, Vec3(2.0, -1.0, 2.0) / 3.0));
  scene.bodies = {box_at({0.0, 0.0, 0.0}, {0.4, 0.1, 0.2}, 2.0),
                  box_at({0.83, 0.05, -0.04}, {0.4, 0.15, 0.1}, 5.0, q),
                  box_at({1.6, 0.3, 0.1}, {0.3, 0.1, 0.25}, 1.0)};
  for (int i = 0; i < 3; ++i) {
    scene.bodies[index(i)].velocity = {0.3 * i, 0.7 - 0.2 * i, -0.4};
    scene.bodies[index(i)].angular_velocity = {0.5, -1.0 * i, 2.0};
  }
  scene.joints.emplace_back(between<BallJoint>(0, {0.4, 0.0, 0.0}, 1, {-0.4, 0.02, 0.01}));
  HingeJoint hinge = between<HingeJoint>(1, {0.4, 0.0, 0.0}, 2, {-0.35, 0.0, 0.0});
  hinge.axis_b = Vec3(0.05, -0.3, 1.0).normalized();
  scene.joints.emplace_back(hinge);
  return scene;
}

/// A chain of rods on hinges from the world, the second hinge open.
Scene open_chain(double gap) {
  scenes::RopeOptions rope;
  rope.n = 5;
  rope.end_mass = 20.0;
  rope.compliance = 0.0;
  Scene scene = scenes::rope_of_n(rope);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    scene.bodies[i].position.x() += gap;  // all but the first link
  }
  return scene;
}

double distance(const Scene& scene, const State& from, const State& to) {
  double sum = 0.0;  // of M (q - q0)^2, rotations by their vectors
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    const Eigen::AngleAxisd turn(to.q[i] * from.q[i].conjugate());
    const Vec3 angle_B = from.q[i].conjugate() * Vec3(turn.angle() * turn.axis());
    sum += body.mass * (to.x[i] - from.x[i]).squaredNorm() +
           angle_B.dot(body.inertia.cwiseProduct(angle_B));
  }
  return sum;
}

Vec3 centre_of_mass(const Scene& scene, const State& state) {
  Vec3 sum = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    sum += scene.bodies[i].mass * state.x[i];
    mass += scene.bodies[i].mass;
  }
  return sum / mass;
}

TEST(Start, OfAShippedSceneIsConsistentOrKept) {
  for (const Scene& scene : scenes::shipped()) {
    const Start start = start_of_run(scene);
    EXPECT_EQ(start.report.found.consistent(), scene.start == StartPolicy::kProject)
        << scene.name << ": " << start_text(scene, start.report);
    EXPECT_FALSE(start.report.projected);
    EXPECT_EQ(state_hash(start.state), state_hash(initial_state(scene))) << scene.name;
  }
}

TEST(Start, NudgesOfASeedAreConsistent) {
  for (int seed = 1; seed <= 8; ++seed) {
    const Scene scene = start_of(scenes::bridge(), 1.0, seed);
    EXPECT_FALSE(start_of_run(scene).report.projected) << seed;
  }
}

TEST(Start, OfAnOpenJointAddsNoEnergyOnceProjected) {
  Scene scene = open_chain(0.09);
  Settings settings;
  settings.mode = Mode::kConst;
  settings.n = 64;
  settings.integrator = Integrator::kLeapfrog;
  const auto greatest_change = [&](double& begun) {
    Simulator simulator = simulator_of(scene, settings);
    begun = simulator.observe().energy;
    double most = 0.0;
    for (int frame = 0; frame < 60; ++frame) {
      keep_largest(most, std::abs(simulator.step().energy - begun));
    }
    return most;
  };
  double begun = 0.0;
  const double projected = greatest_change(begun);
  const StartReport report = start_of_run(scene).report;
  EXPECT_TRUE(report.projected);
  EXPECT_NEAR(report.found.gap, 0.09, 1e-12);
  EXPECT_EQ(report.found.gap_joint, 1);
  EXPECT_LT(report.left.gap, 1e-13);
  EXPECT_EQ(report.energy_begun, begun);
  scene.start = StartPolicy::kKeep;
  const double kept = greatest_change(begun);
  EXPECT_EQ(start_of_run(scene).report.energy_begun, begun);
  // With `keep` the drift correction pulls the chain together violently.
  EXPECT_GT(kept, 30.0);
  // 64 leapfrog sub-steps keep this chain's energy within a thousandth of the exchanged energy, 100
  // J.
  EXPECT_LT(projected, 0.2);
}

TEST(Start, OfTwoPointsMeetsAtTheirCentreOfMass) {
  Scene scene;
  scene.effects.joints = true;
  scene.bodies = {box_at({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}, 3.0),
                  box_at({0.05, -0.02, 0.01}, {0.5, 0.5, 0.5}, 1.0)};
  scene.bodies[0].velocity = {1.0, 0.0, 0.0};
  scene.joints.emplace_back(between<BallJoint>(0, Vec3::Zero(), 1, Vec3::Zero()));
  const Start start = start_of_run(scene);
  const Vec3 meeting = 0.25 * scene.bodies[1].position;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((start.state.x[i] - meeting).norm(), 1e-16);
    EXPECT_LT((start.state.u[i] - (Vec6() << 0.75, 0, 0, 0, 0, 0).finished()).norm(), 1e-15);
    EXPECT_EQ(start.state.u[i], start.state.u_synchronised[i]);
  }
}

TEST(Start, IsProjectedByTheLeastChange) {
  const Scene scene = scattered();
  const State before = initial_state(scene);
  const Start start = start_of_run(scene);
  ASSERT_TRUE(start.report.projected);
  EXPECT_GT(start.report.found.gap, 0.03);
  EXPECT_GT(start.report.found.tilt, 0.05);
  EXPECT_LT(start.report.left.gap, 1e-12);
  EXPECT_LT(start.report.left.tilt, 1e-12);
  EXPECT_LT((centre_of_mass(scene, start.state) - centre_of_mass(scene, before)).norm(), 1e-14);
  // Every other closed start nearby is farther away. A move along the joints changes the squared
  // distance to second order: a move of 1e-3 adds 1e-6 of the masses; a remaining first-order term
  // would show as 1e-3 of the distance.
  const double least = distance(scene, before, start.state);
  for (int body = 0; body < 3; ++body) {
    for (int dof = 0; dof < 6; ++dof) {
      for (const double by : {1e-3, -1e-3}) {
        State other = start.state;
        if (dof < 3) {
          other.x[index(body)][dof] += by;
        } else {
          other.q[index(body)] =
              Quat(Eigen::AngleAxisd(by, Vec3::Unit(dof - 3))) * other.q[index(body)];
        }
        ASSERT_EQ(close_joints(scene, other), Projection::kDone);
        EXPECT_GT(distance(scene, before, other), least * (1.0 - 1e-3)) << body << ' ' << dof;
        // close_joints() from there goes to its own nearest closed start, not back: that one
        // differs.
        EXPECT_GT(distance(scene, start.state, other), 1e-10);
      }
    }
  }
}

TEST(Start, ProjectedVelocitiesKeepMomentaAndLoseTheLeastEnergy) {
  Scene scene = scattered();
  State state = initial_state(scene);
  ASSERT_EQ(close_joints(scene, state), Projection::kDone);
  const Momenta before = momenta_of(scene, state);
  const double energy = energies_of(scene, state).kinetic;
  State matched = state;
  ASSERT_EQ(match_velocities(scene, matched), Projection::kDone);
  const Momenta after = momenta_of(scene, matched);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-13);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-13);
  // u = u0 + M^-1 J^T p with J u = 0 splits the energy by Pythagoras: the loss is the energy of the
  // change itself.
  State change = matched;
  for (std::size_t i = 0; i < change.u.size(); ++i) {
    change.u_synchronised[i] = matched.u[i] - state.u[i];
  }
  EXPECT_NEAR(energies_of(scene, matched).kinetic + energies_of(scene, change).kinetic, energy,
              1e-12);
  EXPECT_GT(energies_of(scene, change).kinetic, 0.1);
}

/// Four rods on hinges about z, a square with side 1: three of its twenty rows are redundant.
Scene four_bar(double open) {
  Scene scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  const Quat quarter(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  const Vec3 half{0.5, 0.05, 0.05};
  scene.bodies = {box_at({0.0, 0.5, 0.0}, half, 1.0, quarter), box_at({0.5, 1.0, 0.0}, half, 3.0),
                  box_at({1.0 + open, 0.5, 0.4 * open}, half, 1.0, quarter)};
  const Vec3 end{0.5, 0.0, 0.0};
  scene.joints = {between<HingeJoint>(0, -end, kWorld, Vec3::Zero()),
                  between<HingeJoint>(1, -end, 0, end), between<HingeJoint>(2, end, 1, end),
                  between<HingeJoint>(2, -end, kWorld, Vec3(1.0, 0.0, 0.0))};
  scene.bodies[1].velocity = {1.0, 0.3, 0.2};
  return scene;
}

TEST(Start, OfALoopIsClosedThoughItsRowsAreRedundant) {
  const Scene scene = four_bar(0.05);
  const Start start = start_of_run(scene);
  ASSERT_TRUE(start.report.projected) << start_text(scene, start.report);
  EXPECT_LT(start.report.left.gap, 1e-11);
  EXPECT_LT(start.report.left.tilt, 1e-11);
  EXPECT_LT(start.report.left.speed, 1e-11);
  EXPECT_LT(start.report.left.turning, 1e-11);
  // The coupler's remaining velocity is along its circle.
  EXPECT_LT(std::abs(start.state.u[1].y()), 0.2);
  EXPECT_LT(std::abs(start.state.u[1].z()), 1e-11);
}

TEST(Start, WithoutANearbyConsistentOneIsKeptAndReported) {
  Scene scene;  // a rod of 1 m between two points 1.1 m apart
  scene.effects.joints = true;
  scene.bodies = {box_at({0.0, 0.0, 0.0}, {0.5, 0.05, 0.05}, 1.0)};
  scene.joints = {between<BallJoint>(0, {0.5, 0.0, 0.0}, kWorld, {0.55, 0.0, 0.0}),
                  between<BallJoint>(0, {-0.5, 0.0, 0.0}, kWorld, {-0.55, 0.0, 0.0})};
  const Start start = start_of_run(scene);
  EXPECT_TRUE(start.report.failed);
  EXPECT_FALSE(start.report.projected);
  EXPECT_EQ(state_hash(start.state), state_hash(initial_state(scene)));
  EXPECT_EQ(start_text(scene, start.report),
            "The start was inconsistent: joint 'joint_0' open by 5 cm; no start nearby closes the "
            "joints, so it is kept. Energy 0 J.");
}

TEST(Start, LeavesTheStretchOfASpring) {
  Scene scene;
  scene.effects = {.gravity = true, .joints = true};
  scene.bodies = {box_at({0.0, -0.00981, 0.0}, {0.1, 0.1, 0.1}, 100.0)};
  scene.joints = {between<BallJoint>(0, Vec3::Zero(), kWorld, Vec3::Zero())};
  base(scene.joints[0]).compliance = 1e-5;
  EXPECT_TRUE(start_of_run(scene).report.found.consistent()) << "it hangs in equilibrium";
  base(scene.joints[0]).compliance = 1e-9;  // 500 Hz: represents an exact joint
  EXPECT_TRUE(start_of_run(scene).report.projected);
}

TEST(Start, AgreesWithExactJointsBesideASpring) {
  // A heavy box on a hinge to a light one that hangs on a spring: the spring's rows are omitted and
  // do not reduce the accuracy of the hinge's.
  Scene scene;
  scene.effects = {.gyroscopic = true, .joints = true};
  scene.bodies = {box_at({0.0, 0.0, 0.0}, {0.3, 0.2, 0.1}, 4.5),
                  box_at({0.6, 0.0, 0.0}, {0.3, 0.4, 0.4}, 42140.0)};
  scene.bodies[0].velocity = {10.0, -20.0, 30.0};
  scene.bodies[1].angular_velocity = {5.0, -40.0, 3.0};
  scene.joints = {between<HingeJoint>(1, {-0.3, 0.0, 0.0}, 0, {0.3, 0.0, 0.0}),
                  between<BallJoint>(0, {-0.3, 0.0, 0.0}, kWorld, {-0.3, 0.1, 0.0})};
  base(scene.joints[1]).compliance = 2.5e-4;
  const Start start = start_of_run(scene);
  ASSERT_TRUE(start.report.projected);
  EXPECT_LT(start.report.left.speed, 1e-10);
  EXPECT_LT(start.report.left.turning, 1e-10);
  EXPECT_EQ(start.state.x[0], scene.bodies[0].position) << "velocities are all that was wrong";
  const Momenta before = momenta_of(scene, initial_state(scene));
  const Momenta after = momenta_of(scene, start.state);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-10);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.angular.norm());
}

TEST(Start, OfASavedRunIsUnchanged) {
  Scene scene = open_chain(0.09);
  scene.carried.emplace(static_cast<const Carried&>(initial_state(scene)));
  const Start start = start_of_run(scene);
  EXPECT_TRUE(start.report.continued);
  EXPECT_FALSE(start.report.projected);
  EXPECT_EQ(state_hash(start.state), state_hash(initial_state(scene)));
  EXPECT_EQ(start_text(scene, start.report), "");
}

TEST(Start, OfASimulatorIsProjectedAndComesBackByReset) {
  const Scene scene = scattered();
  Simulator simulator = simulator_of(scene, {});
  EXPECT_TRUE(simulator.start().projected);
  const std::uint64_t begun = state_hash(simulator.state());
  EXPECT_EQ(begun, state_hash(start_of_run(scene).state));
  EXPECT_LT(simulator.observe().joint_gap, 1e-12);
  simulator.step();
  simulator.reset();
  EXPECT_EQ(state_hash(simulator.state()), begun);
  const Scene closed = *with_start_of_run(std::make_shared<const Scene>(scene));
  EXPECT_TRUE(start_of_run(closed).report.found.consistent());
  EXPECT_EQ(state_hash(initial_state(closed)), begun);
}

// 80 bodies, each pair joined: the first factorisation alone would take 5e8 operations.
TEST(Start, ThatIsTooLargeToProjectIsKept) {
  Scene scene;
  scene.effects = {.joints = true};
  for (int i = 0; i < 80; ++i) {
    const Vec3 at(0.3 * i, 0.2 * (i * i % 7), 0.1 * (i % 5));
    scene.bodies.push_back(box_at(at, Vec3::Constant(0.1), 1.0));
    scene.bodies.back().velocity = Vec3(i % 3, 0.0, i % 2);
    for (int j = 0; j < i; ++j) {
      const Vec3 half_way = 0.5 * (scene.bodies[static_cast<std::size_t>(j)].position - at);
      scene.joints.emplace_back(between<BallJoint>(i, half_way, j, -half_way));
    }
  }
  const Start start = start_of_run(scene);
  EXPECT_TRUE(start.report.failed);
  EXPECT_TRUE(start.report.too_large);
  EXPECT_EQ(state_hash(start.state), state_hash(initial_state(scene)));
  EXPECT_NE(start_text(scene, start.report).find("too large to project"), std::string::npos);
}

TEST(Start, IsReportedInOneLine) {
  const Scene scene = scattered();
  StartReport report = start_of_run(scene).report;
  report.found.gap = 0.09;
  report.found.speed = 1.25;
  report.found.beyond = {.gap = true, .speed = true};
  report.found.gap_joint = 0;
  report.found.speed_joint = 1;
  report.energy_found = 194.0;
  report.energy_begun = 12.5;
  EXPECT_EQ(start_text(scene, report),
            "The start was inconsistent: joint 'joint_0' open by 9 cm, 'joint_1' moving apart at "
            "1.25 m/s; projected. Energy 194 J before, 12.5 J after.");
  report.projected = false;
  EXPECT_EQ(start_text(scene, report),
            "The start was inconsistent: joint 'joint_0' open by 9 cm, 'joint_1' moving apart at "
            "1.25 m/s; kept. Energy 194 J.");
}

}  // namespace
}  // namespace substep::test
