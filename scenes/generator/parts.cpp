#include "scenes/generator/parts.hpp"

#include <cmath>
#include <utility>

namespace substep::scenes {

Scene paper_scene() {
  Scene scene;
  scene.settings = kPaperSettings;
  scene.criteria.joint_gap = 0.1;
  scene.criteria.energy_gain = kAnyEnergy;
  return scene;
}

Body solid(std::string name, const Shape& shape, double mass, const Vec3& position) {
  Body body;
  body.name = std::move(name);
  body.shape = shape;
  body.mass = mass;
  body.inertia = solid_inertia(shape, mass);
  body.position = position;
  return body;
}

Box box(double x, double y, double z) { return Box{{0.5 * x, 0.5 * y, 0.5 * z}}; }

Body floor_plane(double height) {
  Body body;
  body.name = "floor";
  body.shape = Plane{};
  body.is_static = true;
  body.position = {0.0, height, 0.0};
  return body;
}

void add_ground(double friction, double margin, Scene& scene) {
  scene.contact.compliance = 1e-8;
  scene.contact.friction_compliance = 1e-8;
  scene.contact.margin = margin;
  scene.bodies.push_back(floor_plane());
  scene.bodies.back().friction = friction;
}

void join_planks(int planks, double pitch, double half_width, const Vec3& left, const Vec3& right,
                 Scene& scene) {
  const auto join = [&](int gap, int a, int b, double end_a, const Vec3& end_b) {
    for (const double z : {-half_width, half_width}) {
      BallJoint joint;
      joint.name = "pivot_" + std::to_string(gap) + (z < 0.0 ? "_back" : "_front");
      joint.a = a;
      joint.b = b;
      joint.anchor_a = {end_a, 0.0, z};
      joint.anchor_b = end_b + Vec3{0.0, 0.0, z};
      joint.compliance = 1e-8;
      scene.joints.emplace_back(joint);
    }
  };
  const double end = 0.5 * pitch;
  join(0, 1, kWorld, -end, left);
  for (int i = 1; i < planks; ++i) join(i, i + 1, i, -end, {end, 0.0, 0.0});
  join(planks, planks, kWorld, end, right);
}

namespace {

template <class Kind>
Kind joint_of(std::string name, int a, const Vec3& anchor_a, int b, const Vec3& anchor_b) {
  Kind joint;
  joint.name = std::move(name);
  joint.a = a;
  joint.b = b;
  joint.anchor_a = anchor_a;
  joint.anchor_b = anchor_b;
  return joint;
}

}  // namespace

BallJoint ball_joint(std::string name, int a, const Vec3& anchor_a, int b, const Vec3& anchor_b) {
  return joint_of<BallJoint>(std::move(name), a, anchor_a, b, anchor_b);
}

HingeJoint hinge_joint(std::string name, int a, const Vec3& anchor_a, int b, const Vec3& anchor_b) {
  return joint_of<HingeJoint>(std::move(name), a, anchor_a, b, anchor_b);
}

Quat turn_about_z(double c, double s) {
  // cos(a/2) = sqrt((1 + cos a)/2), sin(a/2) = sin a / (2 cos(a/2)).
  const double half_cosine = std::sqrt(0.5 * (1.0 + c));
  return {half_cosine, 0.0, 0.0, s / (2.0 * half_cosine)};
}

Vec3 world_point(const Body& body, const Vec3& local) {
  return body.position + body.orientation * local;
}

}  // namespace substep::scenes
