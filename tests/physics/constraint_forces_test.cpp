// Reported constraint forces against the equations of motion.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/joint_methods.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/steady_settings.hpp"
#include "tests/unit/tree_scenes.hpp"

namespace substep::test {
namespace {

struct Motion {
  Vec3 velocity;      // angular [rad/s]
  Vec3 linear_rate;   // of the velocity of the centre [m/s^2]
  Vec3 angular_rate;  // of the angular velocity [rad/s^2]
  Quat q;             // body to world
};

/// Accelerations of the bodies at the start of a scene by Newton and Euler's equations, under
/// gravity and given joint forces.
std::vector<Motion> motions_by(const Scene& scene, const std::vector<JointForce>& joints) {
  std::vector<Motion> all;
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    const Body& body = scene.bodies[index(i)];
    Vec3 force = body.mass * scene.gravity;
    Vec3 torque = Vec3::Zero();
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointBase& joint = base(scene.joints[j]);
      // Both forces act at the point of a.
      const Body& a = scene.bodies[index(joint.a)];
      const Vec3 at = a.position + a.orientation * joint.anchor_a;
      const double sign = joint.a == i ? 1.0 : joint.b == i ? -1.0 : 0.0;
      force += sign * joints[j].force;
      torque += sign * (joints[j].torque + (at - body.position).cross(joints[j].force));
    }
    const Vec3 w = body.orientation.conjugate() * body.angular_velocity;
    const Vec3 on_body = body.orientation.conjugate() * torque;
    const Vec3 turned =
        (on_body - w.cross(body.inertia.cwiseProduct(w))).cwiseQuotient(body.inertia);
    all.push_back(
        {body.angular_velocity, force / body.mass, body.orientation * turned, body.orientation});
  }
  return all;
}

/// Acceleration of a point of a body, and of a direction fixed in it.
Vec3 of_direction(const Motion& body, const Vec3& local) {
  const Vec3 r = body.q * local;
  return body.angular_rate.cross(r) + body.velocity.cross(body.velocity.cross(r));
}
Vec3 of_point(const Motion& body, const Vec3& local) {
  return body.linear_rate + of_direction(body, local);
}

/// The largest relative acceleration of the points and axes that joints hold together, relative to
/// the largest of these accelerations.
double unheld(const Scene& scene, const std::vector<JointForce>& forces) {
  const std::vector<Motion> all = motions_by(scene, forces);
  double relative = 0.0;
  double largest = scene.gravity.norm();
  const auto compare = [&](const Vec3& a, const Vec3& b) {
    keep_largest(relative, (a - b).norm());
    keep_largest(largest, a.norm());
  };
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    const bool fixed = j.b == kWorld;
    compare(of_point(all[index(j.a)], j.anchor_a),
            fixed ? Vec3(Vec3::Zero()) : of_point(all[index(j.b)], j.anchor_b));
    if (const auto* hinge = std::get_if<HingeJoint>(&joint)) {
      compare(of_direction(all[index(j.a)], hinge->axis_a),
              fixed ? Vec3(Vec3::Zero()) : of_direction(all[index(j.b)], hinge->axis_b));
    }
  }
  return relative / largest;
}

struct Method {
  std::string name;
  substep::Settings settings;
};

/// Whose forces belong to the start of a sub-step, and hold the joints to rounding.
std::vector<Method> direct_methods() {
  std::vector<Method> direct = {{"default", steady_at(1)}};
  for (const JointMethod& method : joint_methods()) {
    substep::Settings settings = method.settings;
    const bool at_end = settings.solver == SolverKind::kNewton && settings.forces == Forces::kEnd;
    if (entry_of(settings.solver).sweeps || at_end) continue;
    settings.n = 1;
    for (const Drift drift : {Drift::kFull, Drift::kExact, Drift::kSoft}) {
      settings.drift = drift;
      direct.push_back(
          {std::string(method.name) + std::string(" ") + std::to_string(static_cast<int>(drift)),
           settings});
    }
  }
  return direct;
}

TEST(ConstraintForces, OfTheFirstSubstepHoldTheJointsAtTheStart) {
  for (const Scene& scene : {branching_tree(), free_tree(), six_boxes()}) {
    for (const Method& method : direct_methods()) {
      Simulator simulator = simulator_of(scene, method.settings);
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      const ConstraintForces forces = simulator.constraint_forces();
      ASSERT_EQ(forces.joints.size(), scene.joints.size());
      EXPECT_LT(unheld(scene, forces.joints), 1e-11) << scene.name << ' ' << method.name;
      for (const JointForce& joint : forces.joints) EXPECT_EQ(joint.time, 0.0);
    }
  }
}

}  // namespace
}  // namespace substep::test
