#pragma once
// Trees of hinges and ball joints to test the exact motion, with velocities consistent with their
// joints.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/lab/joint_tree.hpp"
#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::test {

/// The joint trees of a scene; fails the test if it has none.
inline JointTree tree_of(const Scene& scene) {
  auto tree = JointTree::of(scene);
  EXPECT_TRUE(tree.has_value()) << scene.name;
  return tree ? *tree : *JointTree::of(scenes::heavy_top());
}

/// Energy of gravity in a motion of a scene, zero at the world's origin [J].
double potential(const Scene& scene, const auto& motion) {
  double energy = 0.0;
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    const Body& body = scene.bodies[index(i)];
    if (!body.is_static) energy -= body.mass * scene.gravity.dot(motion.centre(i));
  }
  return energy;
}

/// Sum of the angular momenta about a point of the world [kg m^2/s].
inline Vec3 angular_momentum(const Scene& scene, const JointTree& tree, const Vec3& about) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    const Body& body = scene.bodies[index(i)];
    if (body.is_static) continue;
    const Quat q = tree.orientation(i);
    const Vec6 u = tree.velocity(i);
    sum += q * body.inertia.cwiseProduct(q.conjugate() * Vec3(u.tail<3>())) +
           body.mass * (tree.centre(i) - about).cross(Vec3(u.head<3>()));
  }
  return sum;
}

/// Adds bodies to a scene one by one, each on a joint to an existing one.
class TreeMaker {
 public:
  explicit TreeMaker(std::string name) {
    scene_.name = std::move(name);
    scene_.effects = {.gravity = true, .gyroscopic = true, .joints = true};
    scene_.criteria.track = 0;
  }
  struct Link {
    int parent = kWorld;
    bool hinge = false;
    Vec3 on_parent = Vec3::Zero();  // in the parent or the world [m]
    Vec3 on_child = Vec3::Zero();   // in the child [m]
    Quat orientation = Quat::Identity();
    Vec3 rate =
        Vec3::Zero();  // of a ball joint: angular velocity, world; of a hinge: z is its rate
  };
  /// @return its index
  int add(const Vec3& size, double mass, const Link& link) {
    const int i = static_cast<int>(scene_.bodies.size());
    Body body = scenes::solid("body_" + std::to_string(i),
                              scenes::box(size.x(), size.y(), size.z()), mass, Vec3::Zero());
    body.orientation = link.orientation;
    Vec3 at = link.on_parent;
    Vec3 v = Vec3::Zero();
    Vec3 omega = Vec3::Zero();
    Quat parent = Quat::Identity();
    if (link.parent != kWorld) {
      const Body& p = scene_.bodies[index(link.parent)];
      parent = p.orientation;
      at = p.position + parent * link.on_parent;
      omega = p.angular_velocity;
      v = p.velocity + omega.cross(parent * link.on_parent);
    }
    const auto join = [&](auto joint) {
      joint.name = "joint_" + std::to_string(i);
      joint.a = i;
      joint.b = link.parent;
      joint.anchor_a = link.on_child;
      joint.anchor_b = link.on_parent;
      scene_.joints.emplace_back(joint);
    };
    if (link.hinge) {
      HingeJoint joint;
      joint.axis_a = Vec3(2.0, 1.0, 2.0) / 3.0;
      const Vec3 axis = link.orientation * joint.axis_a;
      joint.axis_b = parent.conjugate() * axis;
      omega += link.rate.z() * axis;
      join(joint);
    } else {
      omega = link.rate;
      join(BallJoint{});
    }
    const Vec3 arm = -(link.orientation * link.on_child);
    body.position = at + arm;
    body.velocity = v + omega.cross(arm);
    body.angular_velocity = omega;
    scene_.bodies.push_back(body);
    return i;
  }
  [[nodiscard]] const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

inline Quat some_rotation(double angle, double x, double y, double z) {
  return Quat(Eigen::AngleAxisd(angle, Vec3(x, y, z).normalized()));
}

/// Six boxes on ball joints, released at rest from a non-planar pose.
inline Scene six_boxes() {
  TreeMaker maker("six_boxes");
  int last = kWorld;
  for (int i = 0; i < 6; ++i) {
    const double side = 0.3 * (i % 3 - 1);
    last = maker.add({0.5, 0.2, 0.1}, 1.0 + i,
                     {.parent = last,
                      .on_parent = last == kWorld ? Vec3(0.0, 4.0, 0.0) : Vec3(0.25, 0.0, 0.02),
                      .on_child = {-0.25, 0.01, 0.0},
                      .orientation = some_rotation(0.4 + side, 0.2, side, 1.0)});
  }
  return maker.scene();
}

/// Seven bodies on four ball joints and three hinges, with two branches, all of them moving.
inline Scene branching_tree() {
  TreeMaker maker("branching_tree");
  const int trunk = maker.add({0.8, 0.3, 0.2}, 4.0,
                              {.on_parent = {0.5, 3.0, -0.5},
                               .on_child = {-0.4, 0.1, 0.0},
                               .orientation = some_rotation(-1.0, 0.3, 0.1, 1.0),
                               .rate = {0.5, 2.0, -1.0}});
  const int left = maker.add({0.5, 0.2, 0.1}, 1.0,
                             {.parent = trunk,
                              .hinge = true,
                              .on_parent = {0.4, 0.1, 0.1},
                              .on_child = {-0.25, 0.0, 0.05},
                              .orientation = some_rotation(0.7, 1.0, 0.4, 0.2),
                              .rate = {0.0, 0.0, 3.0}});
  const int right = maker.add({0.3, 0.4, 0.2}, 2.5,
                              {.parent = trunk,
                               .on_parent = {0.4, -0.1, -0.1},
                               .on_child = {0.0, 0.2, 0.0},
                               .orientation = some_rotation(0.3, 0.1, 1.0, 0.2),
                               .rate = {-1.0, 4.0, 0.5}});
  maker.add({0.2, 0.6, 0.1}, 0.7,
            {.parent = left,
             .on_parent = {0.25, 0.0, 0.0},
             .on_child = {0.0, 0.3, 0.0},
             .orientation = some_rotation(1.2, 0.1, 0.2, 1.0),
             .rate = {1.0, 0.0, 2.0}});
  maker.add({0.4, 0.3, 0.1}, 1.5,
            {.parent = left,
             .hinge = true,
             .on_parent = {0.0, 0.1, 0.0},
             .on_child = {0.2, 0.0, 0.0},
             .orientation = some_rotation(2.0, 1.0, 0.2, 0.5),
             .rate = {0.0, 0.0, -2.0}});
  const int arm = maker.add({0.5, 0.1, 0.2}, 0.5,
                            {.parent = right,
                             .hinge = true,
                             .on_parent = {0.0, -0.2, 0.1},
                             .on_child = {-0.25, 0.0, 0.0},
                             .orientation = some_rotation(0.9, 0.4, 0.1, 1.0),
                             .rate = {0.0, 0.0, 5.0}});
  maker.add({0.3, 0.2, 0.1}, 6.0,
            {.parent = arm,
             .on_parent = {0.25, 0.0, 0.0},
             .on_child = {-0.15, 0.05, 0.0},
             .orientation = some_rotation(0.2, 1.0, 1.0, 1.0),
             .rate = {0.0, 1.0, 3.0}});
  return maker.scene();
}
constexpr int branching_degrees() { return 4 * 3 + 3; }

/// The branching tree, detached from the world.
inline Scene free_tree() {
  Scene scene = branching_tree();
  scene.name = "free_tree";
  scene.joints.erase(scene.joints.begin());
  return scene;
}

/// Mass [kg], centre [m] and velocity [m/s] of all bodies.
inline std::tuple<double, Vec3, Vec3> centre_of_mass(const Scene& scene) {
  double mass = 0.0;
  Vec3 at = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  for (const Body& body : scene.bodies) {
    mass += body.mass;
    at += body.mass * body.position;
    velocity += body.mass * body.velocity;
  }
  return {mass, at / mass, velocity / mass};
}

/// The same scene with its bodies and joints in another order, and every second joint reversed.
/// @param place index in the new scene of each body
inline Scene shuffled(const Scene& scene, unsigned seed, std::vector<int>& place) {
  std::mt19937 random(seed);
  std::vector<int> from(scene.bodies.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<int>(i);
  std::shuffle(from.begin(), from.end(), random);
  place.resize(from.size());
  Scene other = scene;
  for (std::size_t i = 0; i < from.size(); ++i) {
    other.bodies[i] = scene.bodies[index(from[i])];
    place[index(from[i])] = static_cast<int>(i);
  }
  bool swap = false;
  for (Joint& joint : other.joints) {
    JointBase& j = base(joint);
    j.a = place[index(j.a)];
    if (j.b == kWorld) continue;
    j.b = place[index(j.b)];
    swap = !swap;
    if (!swap) continue;
    std::swap(j.a, j.b);
    std::swap(j.anchor_a, j.anchor_b);
    if (auto* hinge = std::get_if<HingeJoint>(&joint)) std::swap(hinge->axis_a, hinge->axis_b);
  }
  std::shuffle(other.joints.begin(), other.joints.end(), random);
  return other;
}

}  // namespace substep::test
