#pragma once
// Scenes moved, rotated, combined and in other units.

#include <variant>
#include <vector>

#include "core/model/joint_fields.hpp"
#include "core/model/scene.hpp"

namespace substep::test {

/// The whole scene rotated about the origin and moved, including gravity.
inline Scene transformed(Scene scene, const Quat& R, const Vec3& by) {
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
    std::visit(
        [&](auto& of) {
          if constexpr (requires { of.axis_b; }) of.axis_b = R * of.axis_b;
          if constexpr (requires { of.across_b; }) of.across_b = R * of.across_b;
        },
        joint);
  }
  return scene;
}

/// The same scene in other units: masses times `mass`, lengths times `length`, times times `time`.
/// A compliance is a length per force (time^2 / mass), an angular one an angle per torque.
inline Scene in_units(Scene scene, double mass, double length, double time = 1.0) {
  const double speed = length / time;
  const double compliance = time * time / mass;
  scene.frame *= time;
  scene.gravity *= length / (time * time);
  scene.contact.compliance *= compliance;
  scene.contact.friction_compliance *= compliance;
  scene.contact.soft_compliance *= compliance;
  scene.contact.margin *= length;
  scene.contact.restitution_speed *= speed;
  scene.regularisation /= mass;
  scene.settings.drift_tau *= time;
  Criteria criteria;
  criteria.duration = scene.criteria.duration;
  criteria.energy_gain = scene.criteria.energy_gain;
  if (scene.criteria.joint_gap) criteria.joint_gap = *scene.criteria.joint_gap * length;
  criteria.track = scene.criteria.track;
  scene.criteria = criteria;
  for (Body& body : scene.bodies) {
    if (auto* sphere = std::get_if<Sphere>(&body.shape)) sphere->radius *= length;
    if (auto* box = std::get_if<Box>(&body.shape)) box->half_extents *= length;
    body.mass *= mass;
    body.inertia *= mass * length * length;
    body.position *= length;
    body.velocity *= speed;
    body.angular_velocity /= time;
    body.force *= mass * speed / time;
    body.torque *= mass * speed / time * length;
  }
  for (Joint& joint : scene.joints) {
    base(joint).anchor_a *= length;
    base(joint).anchor_b *= length;
    base(joint).compliance *= compliance;
    std::visit(
        [&](auto& of) {
          if constexpr (requires { of.length; }) of.length *= length;
          if constexpr (requires { of.angular_compliance; }) {
            of.angular_compliance *= compliance / (length * length);
          }
          [[maybe_unused]] const bool slides = of.kSlides || rope_length_of(joint).has_value();
          if constexpr (requires { of.limit; }) {
            if (of.limit && slides) {
              of.limit->lower *= length;
              of.limit->upper *= length;
            }
          }
          if constexpr (requires { of.motor; }) {
            const double unit = slides ? length : 1.0;
            const double effort = mass * speed / time * (slides ? 1.0 : length);
            if (of.motor) {
              of.motor->velocity *= slides ? speed : 1.0 / time;
              of.motor->effort *= effort;
            }
            if (of.armature) *of.armature *= mass * (slides ? 1.0 : length * length);
            if (of.friction) *of.friction *= effort;
            if (of.spring) {
              of.spring->rest *= unit;
              of.spring->stiffness *= effort / unit;
              of.spring->damping *= effort / unit * time;
            }
            if (of.drive) {
              of.drive->target *= unit;
              of.drive->velocity *= unit / time;
              of.drive->stiffness *= effort / unit;
              of.drive->damping *= effort / unit * time;
              if (of.drive->effort) *of.drive->effort *= effort;
            }
          }
        },
        joint);
  }
  return scene;
}

/// The bodies and joints of all scenes in one, with the laws of the first. Bodies from a scene
/// without contacts do not collide.
inline Scene beside(const std::vector<Scene>& scenes) {
  Scene all = scenes.front();
  all.bodies.clear();
  all.joints.clear();
  all.criteria = {};
  for (const Scene& scene : scenes) {
    const auto first = static_cast<int>(all.bodies.size());
    all.effects.joints |= scene.effects.joints;
    all.effects.contact |= scene.effects.contact;
    all.effects.friction |= scene.effects.friction;
    all.effects.gyroscopic |= scene.effects.gyroscopic;
    all.effects.external |= scene.effects.external;
    if (scene.effects.contact) all.contact = scene.contact;
    for (const Body& body : scene.bodies) {
      all.bodies.push_back(body);
      all.bodies.back().collides = body.collides && scene.effects.contact;
    }
    for (Joint joint : scene.joints) {
      base(joint).a += first;
      if (base(joint).b != kWorld) base(joint).b += first;
      all.joints.push_back(joint);
    }
  }
  return all;
}

}  // namespace substep::test
