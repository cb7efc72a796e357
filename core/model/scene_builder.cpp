#include "core/model/scene_builder.hpp"

#include <stdexcept>
#include <utility>

#include "core/math/across.hpp"
#include "core/model/effects.hpp"

namespace substep {
namespace {

/// A body's pose; that of the world for kWorld, and for an index that no body has.
std::pair<Vec3, Quat> pose_of(const Scene& scene, int body) {
  if (body < 0 || index(body) >= scene.bodies.size()) return {Vec3::Zero(), Quat::Identity()};
  return {scene.bodies[index(body)].position, scene.bodies[index(body)].orientation};
}

Vec3 point_in(const Scene& scene, int body, const Vec3& point) {
  const auto [x, q] = pose_of(scene, body);
  return q.conjugate() * (point - x);
}

Vec3 axis_in(const Scene& scene, int body, const Vec3& axis) {
  return pose_of(scene, body).second.conjugate() * axis.normalized();
}

void place(const Scene& scene, int a, int b, const Vec3& point, JointBase& joint) {
  joint.name = "joint_" + std::to_string(scene.joints.size());
  joint.a = a;
  joint.b = b;
  joint.anchor_a = point_in(scene, a, point);
  joint.anchor_b = point_in(scene, b, point);
}

/// Sets the directions that a joint keeps parallel. @param along world, unit
void fix_axes(const Scene& scene, const Vec3& along, auto& joint) {
  Vec3 v1;
  Vec3 v2;
  across(along, v1, v2);
  joint.axis_a = axis_in(scene, joint.a, along);
  joint.axis_b = axis_in(scene, joint.b, along);
  joint.across_a = axis_in(scene, joint.a, v1);
  joint.across_b = axis_in(scene, joint.b, v1);
}

/// Calls on_hinge or on_slide with a joint that has an angle or a travel.
void visit_coordinate(Scene& scene, int joint, const auto& on_hinge, const auto& on_slide) {
  Joint& of = scene.joints.at(static_cast<std::size_t>(joint));
  if (auto* hinge = std::get_if<HingeJoint>(&of)) return on_hinge(*hinge);
  if (auto* slide = std::get_if<PrismaticJoint>(&of)) return on_slide(*slide);
  if (auto* slide = std::get_if<CylindricalJoint>(&of)) return on_slide(*slide);
  throw std::invalid_argument(base(of).name + " is no hinge and no slide");
}

}  // namespace

SceneBuilder::SceneBuilder(std::string name) {
  scene_.title = name;
  scene_.name = std::move(name);
}

int SceneBuilder::add(Body body) {
  body.name = "body_" + std::to_string(scene_.bodies.size());
  scene_.bodies.push_back(std::move(body));
  return static_cast<int>(scene_.bodies.size()) - 1;
}

int SceneBuilder::add(Joint joint) {
  scene_.joints.push_back(std::move(joint));
  return static_cast<int>(scene_.joints.size()) - 1;
}

int SceneBuilder::add_body(const Shape& shape, double mass, const Vec3& position) {
  Body body;
  body.shape = shape;
  body.mass = mass;
  body.position = position;
  return add(std::move(body));
}

int SceneBuilder::add_fixed(const Shape& shape, const Vec3& position) {
  Body body;
  body.shape = shape;
  body.is_static = true;
  body.position = position;
  return add(std::move(body));
}

int SceneBuilder::add_ball_joint(int a, int b, const Vec3& point) {
  BallJoint joint;
  place(scene_, a, b, point, joint);
  return add(Joint(std::move(joint)));
}

int SceneBuilder::add_hinge(int a, int b, const Vec3& point, const Vec3& axis) {
  HingeJoint joint;
  place(scene_, a, b, point, joint);
  joint.axis_a = axis_in(scene_, a, axis);
  joint.axis_b = axis_in(scene_, b, axis);
  return add(Joint(std::move(joint)));
}

AngleZero SceneBuilder::zero_of(const HingeJoint& hinge) const {
  Vec3 v1;
  Vec3 v2;
  across(pose_of(scene_, hinge.a).second * hinge.axis_a, v1, v2);
  return {axis_in(scene_, hinge.a, v1), axis_in(scene_, hinge.b, v1)};
}

void SceneBuilder::limit(int joint, double lower, double upper, double restitution) {
  const Limit by{lower, upper, restitution};
  visit_coordinate(
      scene_, joint,
      [&](auto& hinge) {
        hinge.limit = AngleLimit{by, zero_of(hinge)};
      },
      [&](auto& slide) { slide.limit = TravelLimit{by}; });
}

void SceneBuilder::drive(int joint, double velocity, double effort) {
  visit_coordinate(
      scene_, joint,
      [&](auto& hinge) {
        hinge.motor = AngularMotor{{velocity, effort}};
      },
      [&](auto& slide) {
        slide.motor = LinearMotor{{velocity, effort}};
      });
}

void SceneBuilder::drive(int joint, const Drive& by) {
  visit_coordinate(
      scene_, joint,
      [&](auto& hinge) {
        hinge.drive = AngularDrive{by, zero_of(hinge)};
      },
      [&](auto& slide) { slide.drive = LinearDrive{by}; });
}

void SceneBuilder::add_spring(int joint, const Spring& spring) {
  visit_coordinate(
      scene_, joint,
      [&](auto& hinge) {
        hinge.spring = AngularSpring{spring, zero_of(hinge)};
      },
      [&](auto& slide) { slide.spring = LinearSpring{spring}; });
}

void SceneBuilder::rub(int joint, double effort) {
  const auto set = [&](auto& of) { of.friction = effort; };
  visit_coordinate(scene_, joint, set, set);
}

void SceneBuilder::add_armature(int joint, double inertia) {
  const auto set = [&](auto& of) { of.armature = inertia; };
  visit_coordinate(scene_, joint, set, set);
}

int SceneBuilder::add_prismatic(int a, int b, const Vec3& point, const Vec3& axis) {
  PrismaticJoint joint;
  place(scene_, a, b, point, joint);
  fix_axes(scene_, axis.normalized(), joint);
  return add(Joint(std::move(joint)));
}

int SceneBuilder::add_weld(int a, int b, const Vec3& point) {
  WeldJoint joint;
  place(scene_, a, b, point, joint);
  fix_axes(scene_, Vec3::UnitX(), joint);
  return add(Joint(std::move(joint)));
}

int SceneBuilder::add_universal(int a, int b, const Vec3& point, const Vec3& axis_a,
                                const Vec3& axis_b) {
  UniversalJoint joint;
  place(scene_, a, b, point, joint);
  const Vec3 first = axis_a.normalized();
  joint.axis_a = axis_in(scene_, a, first);
  joint.axis_b = axis_in(scene_, b, axis_b - first * first.dot(axis_b));
  return add(Joint(std::move(joint)));
}

int SceneBuilder::add_cylindrical(int a, int b, const Vec3& point, const Vec3& axis) {
  CylindricalJoint joint;
  place(scene_, a, b, point, joint);
  joint.axis_a = axis_in(scene_, a, axis);
  joint.axis_b = axis_in(scene_, b, axis);
  return add(Joint(std::move(joint)));
}

int SceneBuilder::add_rope(int a, int b, const Vec3& on_a, const Vec3& on_b, double length,
                           double restitution) {
  RopeJoint joint;
  place(scene_, a, b, on_a, joint);
  joint.anchor_b = point_in(scene_, b, on_b);
  joint.limit = Limit{.upper = length, .restitution = restitution};
  return add(Joint(std::move(joint)));
}

int SceneBuilder::add_distance(int a, int b, const Vec3& on_a, const Vec3& on_b) {
  DistanceJoint joint;
  place(scene_, a, b, on_a, joint);
  joint.anchor_b = point_in(scene_, b, on_b);
  joint.length = (on_a - on_b).norm();
  return add(Joint(std::move(joint)));
}

std::shared_ptr<const Scene> SceneBuilder::build() const {
  auto scene = std::make_shared<Scene>(scene_);
  for (Body& body : scene->bodies) {
    if (body.is_static || !body.inertia.isZero(0.0)) continue;
    body.inertia = solid_inertia(body.shape, body.mass);
  }
  scene->effects = effects_of(*scene);
  return scene;
}

}  // namespace substep
