#include "core/model/effects_of.hpp"

#include <algorithm>

namespace substep {

Effects effects_of(const Scene& scene) {
  const auto any = [&](auto condition) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), condition);
  };
  const auto colliding = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                       [](const Body& body) { return body.collides; });
  Effects effects;
  effects.gravity = scene.gravity != Vec3::Zero();
  // A body with three equal moments has no gyroscopic torque.
  effects.gyroscopic = any([](const Body& body) {
    return !body.is_static &&
           (body.inertia.x() != body.inertia.y() || body.inertia.y() != body.inertia.z());
  });
  effects.joints = !scene.joints.empty();
  effects.contact =
      colliding > 1 && any([](const Body& body) { return !body.is_static && body.collides; });
  effects.friction = effects.contact && any([](const Body& body) {
                       return !body.is_static && body.collides && body.friction > 0.0;
                     });
  effects.restitution = effects.contact && any([](const Body& body) {
                          return body.collides && body.restitution > 0.0;
                        });
  effects.external = any([](const Body& body) {
    return !body.is_static && (body.force != Vec3::Zero() || body.torque != Vec3::Zero());
  });
  return effects;
}

}  // namespace substep
