#include "core/lab/closed_form.hpp"

#include <cmath>

#include "core/forces/applied_forces.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr double kFlush = 1e-9;  // relative

/// Index of the axis of R that is parallel to v, or -1.
int axis_along(const Mat3& R, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) {
    if (R.col(axis).cross(v).norm() <= kFlush * v.norm()) return axis;
  }
  return -1;
}

std::optional<UniformAcceleration> box_on_slope(const Scene& scene, const Body& box) {
  if (scene.effects.external && box.force != Vec3::Zero()) return std::nullopt;
  if (!scene.effects.gravity || !std::holds_alternative<Box>(box.shape)) return std::nullopt;
  const Body* plane = nullptr;
  for (const Body& body : scene.bodies) {
    if (&body == &box || !body.collides) continue;
    if (plane || !body.is_static || !std::holds_alternative<Plane>(body.shape)) return std::nullopt;
    plane = &body;
  }
  if (!plane || !box.collides || box.velocity.norm() != 0.0 || box.angular_velocity.norm() != 0.0) {
    return std::nullopt;
  }
  const Vec3 n = plane->orientation * Vec3::UnitY();
  const Mat3 R = box.orientation.toRotationMatrix();
  const Vec3& half = std::get<Box>(box.shape).half_extents;
  const double pressing = -n.dot(scene.gravity);
  const Vec3 along = scene.gravity + pressing * n;
  const int up = axis_along(R, n);
  if (up < 0 || pressing <= 0.0) return std::nullopt;
  if (std::abs(n.dot(box.position - plane->position) - half[up]) > kFlush * half[up]) {
    return std::nullopt;
  }
  UniformAcceleration motion{box.position, Vec3::Zero(), Vec3::Zero()};
  const double pulling = along.norm();
  if (pulling <= kFlush * pressing) return motion;
  // Friction is a box in the contact's two tangents: it equals Coulomb's law only along one of
  // them.
  const int forward = axis_along(R, along);
  if (forward < 0) return std::nullopt;
  const double mu = scene.effects.friction ? std::sqrt(box.friction * plane->friction) : 0.0;
  const double held = std::min(mu * pressing, pulling);
  if (held * half[up] > pressing * half[forward]) return std::nullopt;  // it tips over
  motion.acceleration = along * (1.0 - held / pulling);
  return motion;
}

}  // namespace

std::optional<UniformAcceleration> closed_form(const Scene& scene) {
  if (!scene.criteria.track || !scene.joints.empty() || !is_runnable(scene)) return std::nullopt;
  const Body& body = scene.bodies[index(*scene.criteria.track)];
  if (body.is_static) return std::nullopt;
  if (has_applied_forces(scene.effects, {&Effects::gravity, &Effects::external})) return {};
  // The reference assumes a constant energy of rotation, which a torque changes.
  if (scene.effects.external && body.torque != Vec3::Zero()) return std::nullopt;
  if (scene.effects.contact) return box_on_slope(scene, body);
  Vec3 acceleration = scene.effects.gravity ? scene.gravity : Vec3(Vec3::Zero());
  if (scene.effects.external) acceleration += body.force / body.mass;
  return UniformAcceleration{body.position, body.velocity, acceleration};
}

}  // namespace substep
