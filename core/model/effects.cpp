#include "core/model/effects.hpp"

#include <algorithm>

#include "core/model/joint_fields.hpp"
#include "core/model/scene.hpp"

namespace substep {
namespace {

/// True if the condition holds for any moving body.
bool any_moving(const Scene& scene, bool (*condition)(const Body&)) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [condition](const Body& body) { return !body.is_static && condition(body); });
}

}  // namespace

bool needs_gravity(const Scene& scene) { return scene.gravity != Vec3::Zero(); }

// A body with three equal moments has no gyroscopic torque.
bool needs_gyroscopic(const Scene& scene) {
  return any_moving(scene, [](const Body& body) {
    return body.inertia.x() != body.inertia.y() || body.inertia.y() != body.inertia.z();
  });
}

bool needs_joints(const Scene& scene) { return !scene.joints.empty(); }

bool needs_contact(const Scene& scene) {
  const auto colliding = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                       [](const Body& body) { return body.collides; });
  return colliding > 1 && any_moving(scene, [](const Body& body) { return body.collides; });
}

bool needs_friction(const Scene& scene) {
  return any_moving(scene, [](const Body& body) { return body.collides && body.friction > 0.0; });
}

bool needs_restitution(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& body) { return body.collides && body.restitution > 0.0; }) ||
         std::any_of(scene.joints.begin(), scene.joints.end(), [](const Joint& joint) {
           const Limit* limit = limit_of(joint);
           return limit != nullptr && limit->restitution > 0.0;
         });
}

bool needs_limits(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), limit_of);
}

bool needs_motors(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), motor_of);
}

bool needs_drives(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), drive_of);
}

bool needs_springs(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), spring_of);
}

bool needs_joint_friction(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), friction_of);
}

bool needs_armature(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(),
                     [](const Joint& joint) { return armature_of(joint) > 0.0; });
}

bool needs_external(const Scene& scene) {
  return any_moving(scene, [](const Body& body) {
    return body.force != Vec3::Zero() || body.torque != Vec3::Zero();
  });
}

Effects effects_of(const Scene& scene) {
  Effects effects;
  for (const EffectEntry& effect : kEffects) effects.*effect.member = effect.needed(scene);
  disable_dependents(effects);
  return effects;
}

}  // namespace substep
