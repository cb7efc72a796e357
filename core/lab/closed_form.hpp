#pragma once

#include <optional>

#include "core/model/scene.hpp"

namespace substep {

/// A motion with constant acceleration: x(t) = start + velocity t + acceleration t^2 / 2.
struct UniformAcceleration {
  Vec3 start = Vec3::Zero();         // [m]
  Vec3 velocity = Vec3::Zero();      // [m/s]
  Vec3 acceleration = Vec3::Zero();  // [m/s^2]

  [[nodiscard]] Vec3 at(double t) const {
    return start + velocity * t + 0.5 * acceleration * t * t;
  }
};

/// The tracked body's motion if it has a closed form: free flight (no joints, contact or torque; a
/// constant force is allowed), or a single box initially at rest, flush on a plane and aligned with
/// the slope, that sticks or slides without tipping over.
std::optional<UniformAcceleration> closed_form(const Scene& scene);

}  // namespace substep
