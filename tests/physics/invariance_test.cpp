// What must not change the motion.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "scenes/generator/scenes.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

/// The whole scene turned about the origin and moved, gravity too.
Scene transformed(Scene scene, const Quat& R, const Vec3& by) {
  scene.gravity = R * scene.gravity;
  for (Body& body : scene.bodies) {
    body.position = R * body.position + by;
    body.orientation = R * body.orientation;
    body.velocity = R * body.velocity;
    body.angular_velocity = R * body.angular_velocity;
  }
  for (Joint& joint : scene.joints) {
    if (base(joint).b != kWorld) continue;
    base(joint).anchor_b = R * base(joint).anchor_b + by;
    if (auto* hinge = std::get_if<HingeJoint>(&joint)) hinge->axis_b = R * hinge->axis_b;
  }
  return scene;
}

struct Case {
  std::string name;
  Scene scene;
  double seconds;    // short enough that rounding has not grown
  double tolerance;  // on the tracked body [m]
};

std::vector<Case> cases() {
  return {{"swinging_box", scenes::swinging_box(), 5.0, 1e-6},
          {"bridge", scenes::bridge(), 0.5, 1e-5},
          {"heavy_stack_stress", scenes::heavy_stack_stress(), 1.0, 1e-7}};
}

void expect_same(const Case& c, const Outcome& a, const Outcome& b, const Quat& R, const Vec3& by) {
  ASSERT_EQ(a.n, b.n) << c.name;
  ASSERT_EQ(a.track.size(), b.track.size());
  for (std::size_t i = 0; i < a.track.size(); ++i) {
    ASSERT_LT((R * a.track[i] + by - b.track[i]).norm(), c.tolerance) << c.name << " frame " << i;
  }
}

TEST(Invariance, AKilometreAwaySubstepsAndMotionAreTheSame) {
  const Vec3 by{1000.0, -300.0, 700.0};
  for (const Case& c : cases()) {
    const Outcome here = run(c.scene, c.scene.settings, c.seconds);
    const Outcome there =
        run(transformed(c.scene, Quat::Identity(), by), c.scene.settings, c.seconds);
    expect_same(c, here, there, Quat::Identity(), by);
  }
}

TEST(Invariance, TurnedWithGravitySubstepsAndMotionAreTheSame) {
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.3, -0.5, 0.8)}) {
    const Quat R(Eigen::AngleAxisd(1.1, axis.normalized()));
    for (const Case& c : cases()) {
      const Outcome here = run(c.scene, c.scene.settings, c.seconds);
      const Outcome turned =
          run(transformed(c.scene, R, Vec3::Zero()), c.scene.settings, c.seconds);
      expect_same(c, here, turned, R, Vec3::Zero());
    }
  }
}

TEST(Invariance, TheOrderOfBodiesAndJointsDoesNotMatterToTheDirectSolver) {
  Case c = cases()[0];
  Scene shuffled = c.scene;
  const std::size_t n = c.scene.bodies.size();
  // Bodies reversed; joints keep their bodies.
  std::reverse(shuffled.bodies.begin(), shuffled.bodies.end());
  std::reverse(shuffled.joints.begin(), shuffled.joints.end());
  const auto moved_to = [&](int body) {
    return body == kWorld ? kWorld : static_cast<int>(n) - 1 - body;
  };
  for (Joint& joint : shuffled.joints) {
    base(joint).a = moved_to(base(joint).a);
    base(joint).b = moved_to(base(joint).b);
  }
  shuffled.criteria.track = moved_to(*c.scene.criteria.track);
  expect_same(c, run(c.scene, c.scene.settings, c.seconds),
              run(shuffled, shuffled.settings, c.seconds), Quat::Identity(), Vec3::Zero());
}

TEST(Invariance, ASnapshotGoesOnBitForBit) {
  for (const Scene& scene :
       {scenes::swinging_box(), scenes::bridge(), scenes::heavy_stack_stress()}) {
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
        const auto shared = std::make_shared<const Scene>(scene);
        Settings settings = scene.settings;
        settings.solver = solver;
        settings.policy = policy;
        settings.warm_start = true;
        Simulator whole(shared);
        whole.set_settings(settings);
        for (int i = 0; i < 40; ++i) whole.step();
        Simulator rest(shared);
        rest.set_settings(settings);
        rest.set_state(whole.state());
        for (int i = 0; i < 40; ++i) {
          whole.step();
          rest.step();
          ASSERT_EQ(state_hash(whole.state()), state_hash(rest.state())) << scene.name << " " << i;
        }
      }
    }
  }
}

TEST(Invariance, ResetIsTheStart) {
  const auto shared = std::make_shared<const Scene>(scenes::bridge());
  Simulator simulator(shared);
  for (int i = 0; i < 30; ++i) simulator.step();
  const std::uint64_t once = state_hash(simulator.state());
  simulator.reset();
  for (int i = 0; i < 30; ++i) simulator.step();
  EXPECT_EQ(state_hash(simulator.state()), once);
}

struct Momentum {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
};

Momentum momentum_of(const Scene& scene, const State& state) {
  Momentum sum;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const Vec6& u = state.u_synchronised[i];
    const Mat3 R = state.q[i].toRotationMatrix();
    sum.linear += body.mass * u.head<3>();
    sum.angular += body.mass * state.x[i].cross(u.head<3>()) +
                   R * body.inertia.cwiseProduct(R.transpose() * u.tail<3>());
  }
  return sum;
}

/// A chain that tumbles freely: hinges and ball joints, no gravity.
Scene tumbling_chain() {
  scenes::RopeOptions options;
  options.n = 6;
  options.end_mass = 3.0;
  Scene scene = scenes::rope_of_n(options);
  scene.effects = {.gyroscopic = true, .joints = true};
  scene.joints.erase(scene.joints.begin());  // let go of the world
  scene.joints[2] = [&] {
    BallJoint ball;
    static_cast<JointBase&>(ball) = base(scene.joints[2]);
    return Joint(ball);
  }();
  std::erase_if(scene.bodies, [](const Body& body) { return body.is_static; });
  // One rigid motion to start with: v = V + W x (x - x_0), consistent with all joints.
  const Vec3 W{1.0, -2.0, 3.0};
  for (Body& body : scene.bodies) {
    body.angular_velocity = W;
    body.velocity = Vec3(0.5, 0.2, -0.1) + W.cross(body.position - scene.bodies[0].position);
  }
  scene.criteria = Criteria{};
  return scene;
}

TEST(Invariance, AFreeChainKeepsItsMomentum) {
  Scene scene = tumbling_chain();
  const auto worst = [&](SolverKind solver, int n) {
    Settings settings;
    settings.solver = solver;
    settings.mode = Mode::kConst;
    settings.n = n;
    settings.integrator = Integrator::kLeapfrog;
    const Momentum start = momentum_of(scene, initial_state(scene));
    Momentum drift;
    run(scene, settings, 5.0, [&](const Simulator& simulator, const FrameReport&) {
      const Momentum now = momentum_of(scene, simulator.state());
      drift.linear = drift.linear.cwiseMax((now.linear - start.linear).cwiseAbs());
      drift.angular = drift.angular.cwiseMax((now.angular - start.angular).cwiseAbs());
    });
    drift.linear /= start.linear.norm();
    drift.angular /= start.angular.norm();
    return drift;
  };
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    EXPECT_LT(worst(solver, 8).linear.norm(), 1e-12);
  }
  // The forces of a joint act at two points phi apart (second order), and the gyroscopic torque of
  // a sub-step does not yet know the joint impulses of that sub-step (first order, and small).
  const double eight = worst(SolverKind::kBpp, 8).angular.norm();
  const double sixteen = worst(SolverKind::kBpp, 16).angular.norm();
  EXPECT_LT(eight, 2e-5);
  EXPECT_LT(sixteen, eight / 2.0);
}

}  // namespace
}  // namespace substep::test
