#pragma once
// Random valid scenes: chains, trees and rings of joints, and heaps of bodies that touch or
// overlap, with extreme masses, moments, friction, compliance and speeds, under any settings.

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/math/across.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/names.hpp"
#include "core/model/scene.hpp"
#include "core/model/setting_fields.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {

inline int whole(int least, int most) { return *rc::gen::inRange(least, most + 1); }
inline bool one_in(int n) { return whole(1, n) == 1; }

/// Uniform from `least` to `most`; shrinks towards `least`.
inline double number(double least, double most) {
  constexpr int kSteps = 1 << 20;
  return least + (most - least) * whole(0, kSteps) / kSteps;
}
/// Uniform in the logarithm.
inline double magnitude(double least, double most) {
  return std::exp(number(std::log(least), std::log(most)));
}
inline Vec3 vector(double most) {
  return {number(-most, most), number(-most, most), number(-most, most)};
}
inline Vec3 unit_vector() {
  const Vec3 v = vector(1.0);
  return v.norm() > 1e-3 ? Vec3(v.normalized()) : Vec3::UnitX();
}
inline Quat orientation() {
  if (one_in(3)) return Quat::Identity();
  return Quat(Eigen::AngleAxisd(number(0.0, 3.0), unit_vector())).normalized();
}
template <class Enum>
Enum any_of() {
  return static_cast<Enum>(whole(0, static_cast<int>(kNames<Enum>.size()) - 1));
}

inline Shape any_shape() {
  switch (whole(0, 3)) {
    case 0:
      return Box{Vec3::Constant(number(0.05, 0.5))};  // cubes, whose faces and corners meet
    case 1:
      return Box{
          {number(0.05, 1.0), number(0.001, 0.1), number(0.05, 1.0)}};  // planks, thin plates
    default:
      return Sphere{number(0.01, 0.5)};
  }
}

/// Physically possible moments: from a needle to a plate.
inline Vec3 any_inertia(double mass) {
  const Vec3 extents{magnitude(1e-4, 1.0), magnitude(1e-4, 1.0), magnitude(1e-4, 1.0)};
  return solid_inertia(Box{extents}, mass);
}

inline Body any_body(int index, const Vec3& position) {
  Body body;
  body.name = "body_" + std::to_string(index);
  body.shape = any_shape();
  body.mass = one_in(4) ? magnitude(1e-6, 1e9) : magnitude(0.1, 1000.0);
  body.inertia = one_in(4) ? any_inertia(body.mass) : solid_inertia(body.shape, body.mass);
  body.position = position;
  body.orientation = orientation();
  if (one_in(2)) body.velocity = vector(one_in(20) ? 1e5 : 30.0);
  if (one_in(2)) body.angular_velocity = vector(one_in(20) ? 1e5 : 30.0);
  body.friction = one_in(2) ? number(0.0, 2.0) : 0.0;
  body.restitution = one_in(3) ? number(0.0, 1.0) : 0.0;
  body.collides = !one_in(10);
  body.collision_group = one_in(5) ? whole(0, 1) : -1;
  return body;
}

inline double any_compliance() { return one_in(2) ? 0.0 : magnitude(1e-12, 1e-2); }

/// Joins body a to body b, or to the world, at a point of the world.
inline void join(Scene& scene, int a, int b, const Vec3& point) {
  const auto local = [&](int body, const Vec3& p) -> Vec3 {
    if (body == kWorld) return p;
    const Body& of = scene.bodies[static_cast<std::size_t>(body)];
    return of.orientation.conjugate() * (p - of.position);
  };
  const auto turned = [&](int body, const Vec3& axis) -> Vec3 {
    if (body == kWorld) return axis;
    return scene.bodies[static_cast<std::size_t>(body)].orientation.conjugate() * axis;
  };
  JointBase common;
  common.name = "joint_" + std::to_string(scene.joints.size());
  common.a = a;
  common.b = b;
  common.anchor_a = local(a, point);
  common.anchor_b = local(b, point);
  common.compliance = any_compliance();
  if (one_in(2)) {
    BallJoint ball;
    static_cast<JointBase&>(ball) = common;
    scene.joints.emplace_back(ball);
    return;
  }
  if (one_in(6)) {
    RopeJoint rope;
    static_cast<JointBase&>(rope) = common;
    rope.compliance = 0.0;
    rope.limit->upper = magnitude(1e-3, 3.0);
    if (one_in(2)) rope.limit->restitution = number(0.0, 1.0);
    scene.joints.emplace_back(rope);
    return;
  }
  const Vec3 axis = unit_vector();
  if (one_in(4)) {
    Vec3 v1;
    Vec3 v2;
    across(axis, v1, v2);
    UniversalJoint cross;
    static_cast<JointBase&>(cross) = common;
    cross.axis_a = turned(a, axis);
    cross.axis_b = turned(b, v1);
    cross.angular_compliance = any_compliance();
    scene.joints.emplace_back(cross);
    return;
  }
  if (one_in(4)) {
    CylindricalJoint cylinder;
    static_cast<JointBase&>(cylinder) = common;
    cylinder.axis_a = turned(a, axis);
    cylinder.axis_b = turned(b, axis);
    cylinder.angular_compliance = any_compliance();
    if (one_in(3)) {
      const double lower = -number(0.0, 3.0);
      const double upper = lower + number(-lower + 1e-3, 4.0);
      cylinder.limit = TravelLimit{{lower, upper, one_in(2) ? 0.0 : number(0.0, 1.0)}};
    }
    if (one_in(4)) cylinder.motor = LinearMotor{{number(-50.0, 50.0), magnitude(1e-6, 1e6)}};
    if (one_in(4)) {
      cylinder.drive = LinearDrive{{.target = number(-5.0, 5.0),
                                    .stiffness = magnitude(1e-9, 1e9),
                                    .damping = magnitude(1e-9, 1e9)}};
    }
    if (one_in(4)) cylinder.friction = magnitude(1e-6, 1e6);
    if (one_in(4)) cylinder.armature = magnitude(1e-12, 1e6);
    scene.joints.emplace_back(cylinder);
    return;
  }
  HingeJoint hinge;
  static_cast<JointBase&>(hinge) = common;
  hinge.axis_a = turned(a, axis);
  hinge.axis_b = turned(b, axis);
  hinge.angular_compliance = any_compliance();
  Vec3 v1;
  Vec3 v2;
  across(axis, v1, v2);
  const AngleZero zero{turned(a, v1), turned(b, v1)};
  if (one_in(3)) {
    const double lower = -number(0.0, 3.0);
    const double upper = lower + number(-lower + 1e-3, 3.0);
    hinge.limit = AngleLimit{{lower, upper, one_in(2) ? 0.0 : number(0.0, 1.0)}, zero};
  }
  if (one_in(4)) hinge.motor = AngularMotor{{number(-50.0, 50.0), magnitude(1e-6, 1e6)}};
  if (one_in(4)) {
    Drive drive{.target = number(-20.0, 20.0), .velocity = number(-5.0, 5.0)};
    drive.stiffness = one_in(4) ? 0.0 : magnitude(1e-9, 1e9);
    drive.damping = one_in(4) && drive.stiffness > 0.0 ? 0.0 : magnitude(1e-9, 1e9);
    if (one_in(2)) drive.effort = magnitude(1e-6, 1e6);
    hinge.drive = AngularDrive{drive, zero};
  }
  if (one_in(4)) {
    hinge.spring = AngularSpring{{number(-20.0, 20.0), magnitude(1e-9, 1e9), 0.0}, zero};
    if (one_in(2)) hinge.spring->damping = magnitude(1e-9, 1e9);
  }
  if (one_in(4)) hinge.friction = magnitude(1e-6, 1e6);
  if (one_in(4)) hinge.armature = magnitude(1e-12, 1e6);
  scene.joints.emplace_back(hinge);
}

inline Vec3 between(const Scene& scene, int a, int b) {
  return 0.5 * (scene.bodies[static_cast<std::size_t>(a)].position +
                scene.bodies[static_cast<std::size_t>(b)].position);
}

/// Bodies on joints: a chain, a tree, or a ring, hanging from the world or free.
inline void add_mechanism(Scene& scene, int bodies) {
  const int first = static_cast<int>(scene.bodies.size());
  const int kind = whole(0, 2);
  Vec3 at{number(-1.0, 1.0), number(1.0, 4.0), number(-1.0, 1.0)};
  for (int i = 0; i < bodies; ++i) {
    const int body = first + i;
    const int parent = kind == 1 && i > 0 ? first + whole(0, i - 1) : body - 1;
    if (i > 0) at = scene.bodies[static_cast<std::size_t>(parent)].position + vector(0.5);
    scene.bodies.push_back(any_body(body, at));
    if (i > 0) join(scene, body, parent, between(scene, body, parent));
  }
  if (one_in(2))
    join(scene, first, kWorld,
         scene.bodies[static_cast<std::size_t>(first)].position + vector(0.5));
  const int last = first + bodies - 1;
  if (kind == 2 && bodies > 2) join(scene, last, first, between(scene, last, first));
}

/// Bodies that rest, fall, touch and overlap, some of them exactly.
inline void add_heap(Scene& scene, int bodies) {
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < bodies; ++i) {
    if (!one_in(8)) at = Vec3(number(-0.5, 0.5), number(0.0, 1.5), number(-0.5, 0.5));
    scene.bodies.push_back(any_body(static_cast<int>(scene.bodies.size()), at));
  }
}

inline void add_ground(Scene& scene) {
  Body ground;
  ground.name = "ground";
  ground.is_static = true;
  ground.shape = one_in(2) ? Shape(Plane{}) : Shape(Box{{5.0, 0.5, 5.0}});
  ground.position = Vec3(0.0, std::holds_alternative<Plane>(ground.shape) ? 0.0 : -0.5, 0.0);
  if (one_in(3)) ground.orientation = Quat(Eigen::AngleAxisd(number(0.0, 1.0), unit_vector()));
  ground.friction = one_in(2) ? number(0.0, 2.0) : 0.0;
  scene.bodies.push_back(ground);
}

inline Settings any_settings() {
  Settings s;
  s.solver = any_of<SolverKind>();
  s.iterations = whole(1, 30);
  s.share_iterations = one_in(4);
  s.warm_start = one_in(2);
  s.forces = any_of<Forces>();
  s.refinements = one_in(4) ? whole(1, 3) : 0;
  s.pivots = whole(1, 20);
  s.mode = any_of<Mode>();
  s.alpha = magnitude(1e-3, 1.0);
  s.n = whole(1, 6);
  s.n_max = whole(1, 6);
  s.n_cap = whole(1, 6);
  s.alpha_m = number(0.01, 0.99);
  s.beta = number(0.0, 1.0);
  s.policy = any_of<Policy>();
  s.memory = number(0.0, 0.99);
  s.islands = one_in(2);
  s.sleep = one_in(3);
  s.probe = one_in(2);
  s.integrator = any_of<Integrator>();
  s.gyroscopic = any_of<Gyroscopic>();
  s.drift = any_of<Drift>();
  s.drift_tau = magnitude(1e-6, 10.0);
  s.drift_order = whole(1, 2);
  s.detection = any_of<Detection>();
  s.contact_stiffness = any_of<ContactStiffness>();
  s.rotation_criterion = one_in(2);
  s.friction_cone = any_of<FrictionCone>();
  s.watch_stiffness = one_in(4);
  return s;
}

inline Scene any_scene() {
  Scene scene;
  scene.name = "random";
  scene.title = "Random";
  scene.frame = magnitude(1.0 / 240.0, 1.0 / 20.0);
  scene.gravity = one_in(4) ? vector(20.0) : Vec3(0.0, -9.81, 0.0);
  const bool grounded = one_in(2);
  if (grounded) add_ground(scene);
  const int kind = whole(0, 2);
  if (kind != 0) add_mechanism(scene, whole(1, 8));
  if (kind != 1) add_heap(scene, whole(1, 8));
  scene.contact.compliance = magnitude(1e-13, 1e-3);
  scene.contact.friction_compliance = magnitude(1e-13, 1e-3);
  scene.contact.margin = one_in(3) ? 0.0 : number(0.0, 0.1);
  scene.contact.restitution_speed = number(0.0, 1.0);
  scene.regularisation = one_in(4) ? magnitude(1e-9, 1e-3) : 0.0;
  Effects& effects = scene.effects;
  effects.gravity = !one_in(5);
  effects.gyroscopic = one_in(2);
  effects.joints = !scene.joints.empty();
  effects.contact = !one_in(8);
  const auto has = [&](double Body::*coefficient) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return body.*coefficient > 0.0; });
  };
  effects.friction = effects.contact && has(&Body::friction);
  effects.limits = needs_limits(scene);
  effects.motors = needs_motors(scene);
  effects.drives = needs_drives(scene);
  effects.springs = needs_springs(scene);
  effects.joint_friction = needs_joint_friction(scene);
  effects.armature = needs_armature(scene);
  const bool limits_rebound =
      std::any_of(scene.joints.begin(), scene.joints.end(), [](const Joint& joint) {
        const Limit* limit = limit_of(joint);
        return limit != nullptr && limit->restitution > 0.0;
      });
  effects.restitution = (effects.contact && has(&Body::restitution)) || limits_rebound;
  scene.settings = any_settings();
  scene.start = one_in(2) ? StartPolicy::kProject : StartPolicy::kKeep;
  effects.external = one_in(4);
  for (Body& body : scene.bodies) {
    if (!effects.external || body.is_static) continue;
    body.force = vector(one_in(20) ? 1e6 : 100.0);
    if (one_in(2)) body.torque = vector(one_in(20) ? 1e4 : 10.0);
  }
  return scene;
}

}  // namespace substep::test
