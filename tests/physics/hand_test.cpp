// Manual interactions with a run: stopping within a frame, pulling a body.

#include <gtest/gtest.h>

#include <cmath>

#include "core/model/grab.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

TEST(InterruptedFrame, EqualsAnUninterruptedOneBitForBit) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::bridge()}) {
    for (const Mode mode : {Mode::kNone, Mode::kConst, Mode::kAdaptive, Mode::kCapped}) {
      for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
        Settings settings = scene.settings;
        settings.mode = mode;
        settings.policy = policy;
        Simulator whole = simulator_of(scene, settings);
        Simulator pieces = simulator_of(scene, settings);
        for (int frame = 0; frame < 12; ++frame) {
          const FrameReport expected = whole.step();
          FrameReport report = pieces.substep();
          for (int i = 0; i < frame % 4 && pieces.substeps_left() > 0; ++i) {
            report = pieces.substep();
          }
          if (pieces.substeps_left() > 0) {
            EXPECT_LT(report.time, expected.time);
            EXPECT_EQ(report.frame, frame);
            report = pieces.step();
          }
          ASSERT_EQ(pieces.substeps_left(), 0);
          ASSERT_EQ(state_hash(pieces.state()), state_hash(whole.state())) << scene.name;
          EXPECT_EQ(report.n_substeps, expected.n_substeps);
          EXPECT_EQ(report.n_wanted, expected.n_wanted);
          EXPECT_EQ(report.energy, expected.energy);
          EXPECT_EQ(report.time, expected.time);
          EXPECT_EQ(report.work.solves, expected.work.solves);
        }
      }
    }
  }
}

TEST(InterruptedFrame, IsDroppedWhenAStateIsSet) {
  const Scene scene = scenes::swinging_box();
  Simulator simulator = simulator_of(scene, scene.settings);
  simulator.step();
  const State kept = simulator.state();
  simulator.step();
  const std::uint64_t expected = state_hash(simulator.state());
  simulator.substep();
  ASSERT_GT(simulator.substeps_left(), 0);
  simulator.set_state(kept);
  EXPECT_EQ(simulator.substeps_left(), 0);
  simulator.step();
  EXPECT_EQ(state_hash(simulator.state()), expected);
}

int heaviest(const Scene& scene) {
  int best = -1;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    if (best < 0 || scene.bodies[i].mass > scene.bodies[static_cast<std::size_t>(best)].mass) {
      best = static_cast<int>(i);
    }
  }
  return best;
}

// A single ball without gravity follows the closed form of a damped oscillator.
TEST(Grab, PullsAsADampedSpring) {
  Scene scene;
  Body ball;
  ball.mass = 2.0;
  ball.inertia = solid_inertia(ball.shape, ball.mass);
  scene.bodies.push_back(ball);
  Settings settings;
  settings.mode = Mode::kConst;
  settings.n = 400;  // implicit Euler adds damping: the error is proportional to dt
  Simulator simulator = simulator_of(scene, settings);
  Grab grab;
  grab.mass = ball.mass;
  grab.target = {0.5, 0.0, 0.0};
  simulator.set_grab(grab);
  const double decay = Grab::kDamping * Grab::kRate;
  const double turn = Grab::kRate * std::sqrt(1.0 - Grab::kDamping * Grab::kDamping);
  for (int frame = 0; frame < 60; ++frame) {
    simulator.step();
    const double t = simulator.state().time;
    const double left =
        0.5 * std::exp(-decay * t) * (std::cos(turn * t) + decay / turn * std::sin(turn * t));
    EXPECT_NEAR(simulator.state().x[0].x(), 0.5 - left, 5e-4) << t;
  }
}

TEST(Grab, LeavesNoTraceAfterItsRelease) {
  const Scene scene = scenes::swinging_box();
  Simulator plain = simulator_of(scene, scene.settings);
  Simulator touched = simulator_of(scene, scene.settings);
  Grab grab;
  grab.body = heaviest(scene);
  touched.set_grab(grab);
  touched.set_grab(std::nullopt);
  for (int frame = 0; frame < 10; ++frame) {
    plain.step();
    touched.step();
  }
  EXPECT_EQ(state_hash(plain.state()), state_hash(touched.state()));
}

TEST(Grab, RaisesTheNumberOfSubsteps) {
  const Scene scene = scenes::swinging_box();
  Simulator plain = simulator_of(scene, scene.settings);
  Simulator pulled = simulator_of(scene, scene.settings);
  Grab grab;
  grab.body = heaviest(scene);
  grab.mass = joined_mass(scene, grab.body);
  EXPECT_NEAR(grab.mass, 1025.0, 1e-9);
  // Away from the anchor, along the chain: its force grows.
  grab.target = 3.0 * pulled.state().x[static_cast<std::size_t>(grab.body)] -
                2.0 * base(scene.joints.front()).anchor_b;
  pulled.set_grab(grab);
  FrameReport a;
  FrameReport b;
  for (int frame = 0; frame < 20; ++frame) {
    a = plain.step();
    b = pulled.step();
  }
  EXPECT_GT(b.n_substeps, a.n_substeps);
}

// Outputs that are computed on demand can be read after any sub-step.
TEST(InterruptedFrame, ShowsForcesAndVelocitiesOfItsLastSubstep) {
  const Scene scene = scenes::swinging_box();
  const int last = static_cast<int>(scene.joints.size()) - 1;
  const JointBase& joint = base(scene.joints[index(last)]);
  const std::size_t box = index(heaviest(scene));
  ASSERT_TRUE(index(joint.a) == box || index(joint.b) == box);
  const double sign = index(joint.a) == box ? 1.0 : -1.0;
  const double m = scene.bodies[box].mass;
  for (const bool warm_start : {false, true}) {
    Settings settings = scene.settings;
    settings.mode = Mode::kConst;
    settings.n = 8;
    settings.warm_start = warm_start;
    const double dt = scene.frame / settings.n;
    Simulator simulator = simulator_of(scene, settings);
    for (int frame = 0; frame < 10; ++frame) simulator.step();
    for (int i = 0; i < 20; ++i) {
      const State before = simulator.state();
      simulator.substep();
      const State& after = simulator.state();
      const Vec3 gained = m * (after.u[box] - before.u[box]).head<3>() / dt;
      const Vec3 pulled = simulator.constraint_forces().joints[index(last)].force;
      const Vec3 expected = gained - m * scene.gravity;
      EXPECT_LT((sign * pulled - expected).norm(), 1e-5 * expected.norm()) << i;
      for (std::size_t body = 0; body < after.u.size(); ++body) {
        // Only translations: the torques of joint forces are evaluated at the new poses.
        const Vec3 now = (after.u[body] + 0.5 * (after.u[body] - before.u[body])).head<3>();
        EXPECT_LT((after.u_synchronised[body].head<3>() - now).norm(), 1e-9 * (1.0 + now.norm()))
            << i;
      }
    }
  }
}

TEST(ConstraintForces, OfAJointCarryTheBodiesBelowIt) {
  Scene scene;
  scene.effects = {.gravity = true, .joints = true};
  for (int i = 0; i < 2; ++i) {
    Body body;
    body.mass = 3.0 + 4.0 * i;
    body.inertia = solid_inertia(body.shape, body.mass);
    body.position = {0.0, -1.0 - i, 0.0};
    scene.bodies.push_back(body);
    BallJoint joint;
    joint.a = i;
    joint.b = i - 1;  // the first one hangs from the world
    joint.anchor_a = {0.0, 1.0, 0.0};
    scene.joints.emplace_back(joint);
  }
  Simulator simulator = simulator_of(scene, scene.settings);
  EXPECT_TRUE(simulator.constraint_forces().joints.empty());
  for (int frame = 0; frame < 3; ++frame) simulator.step();
  const ConstraintForces forces = simulator.constraint_forces();
  ASSERT_EQ(forces.joints.size(), 2U);
  EXPECT_LT((forces.joints[0].force - Vec3(0.0, 98.1, 0.0)).norm(), 1e-3);
  EXPECT_LT((forces.joints[1].force - Vec3(0.0, 68.67, 0.0)).norm(), 1e-3);
}

TEST(ConstraintForces, OfContactsCarryTheBodiesAboveThem) {
  const Scene scene = scenes::heavy_stack();
  double weight = 0.0;
  for (const Body& body : scene.bodies) weight += body.is_static ? 0.0 : 9.81 * body.mass;
  Simulator simulator = simulator_of(scene, scene.settings);
  for (int frame = 0; frame < 60; ++frame) simulator.step();
  Vec3 carried = Vec3::Zero();
  for (const ContactForce& contact : simulator.constraint_forces().contacts) {
    if (scene.bodies[static_cast<std::size_t>(contact.b)].is_static) carried += contact.force;
    const Vec3 point = simulator.state().x[static_cast<std::size_t>(contact.a)] + contact.arm_a;
    EXPECT_GT(point.y(), -1e-3);
    EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-6);
  }
  EXPECT_NEAR(carried.y() / weight, 1.0, 1e-3);
}

struct Yank {
  Scene scene;
  int body;
};

// The pointer jumps from side to side, up and down, far beyond reach, at several periods.
TEST(Grab, ViolentPullingTearsNoJoint) {
  const Scene box = scenes::swinging_box();
  const Scene bridge = scenes::bridge();
  std::vector<Yank> yanks{{box, heaviest(box)}, {bridge, heaviest(bridge)}};
  for (const double along : {0.1, 0.5, 0.9}) {
    for (const Scene& scene : {box, bridge}) {
      const auto joint = static_cast<std::size_t>(along * static_cast<double>(scene.joints.size()));
      yanks.push_back({scene, base(scene.joints[joint]).a});
    }
  }
  for (const Yank& yank : yanks) {
    for (const double period : {0.15, 0.4, 1.1}) {
      Simulator simulator = simulator_of(yank.scene, yank.scene.settings);
      const auto body = static_cast<std::size_t>(yank.body);
      ASSERT_FALSE(yank.scene.bodies[body].is_static);
      const Vec3 start = simulator.state().x[body];
      double gap = 0.0;
      int most = 0;
      for (int frame = 0; frame < 300; ++frame) {
        const double t = frame / 60.0;
        const bool right = std::fmod(t, period) < 0.5 * period;
        const bool up = std::fmod(t, 1.7 * period) < 0.8 * period;
        Grab grab;
        grab.body = yank.body;
        grab.mass = joined_mass(yank.scene, yank.body);
        grab.anchor = {0.0, 0.05, 0.0};
        grab.target =
            start + Vec3(right ? 20.0 : -20.0, up ? 20.0 : -15.0, right != up ? 6.0 : -6.0);
        simulator.set_grab(grab);
        const FrameReport report = simulator.step();
        ASSERT_EQ(report.status, StepStatus::kOk) << yank.scene.name << " body " << yank.body;
        keep_largest(gap, report.joint_gap);
        most = std::max(most, report.n_substeps);
      }
      EXPECT_LT(gap, 0.1) << yank.scene.name << ' ' << yank.scene.bodies[body].name << ", period "
                          << period << " s, N up to " << most;
      RecordProperty(
          yank.scene.name + "_" + yank.scene.bodies[body].name + "_" + std::to_string(period),
          std::to_string(gap) + " m, N " + std::to_string(most));
    }
  }
}

}  // namespace
}  // namespace substep::test
