#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/model/shape.hpp"

namespace substep {

/// A rigid body as the scene describes it. Its frame sits at the centre of mass, axes along the
/// principal axes of inertia.
struct Body {
  std::string name;
  Shape shape = Sphere{};
  bool is_static = false;                // a static body never moves and has no mass
  double mass = 1.0;                     // [kg], > 0 for a moving body
  Vec3 inertia = Vec3::Zero();           // principal moments [kg m^2], > 0 for a moving body
  Vec3 position = Vec3::Zero();          // centre of mass, world [m]
  Quat orientation = Quat::Identity();   // q_WB, unit [-]
  Vec3 velocity = Vec3::Zero();          // world [m/s]
  Vec3 angular_velocity = Vec3::Zero();  // world [rad/s]
  Vec3 force = Vec3::Zero();             // constant, at the centre of mass, world axes [N]
  Vec3 torque = Vec3::Zero();            // constant, about the centre of mass, world axes [N m]
  double friction = 0.0;                 // Coulomb coefficient [-]; a pair uses sqrt(mu_a mu_b)
  double restitution = 0.0;              // e in [0, 1] [-]; a pair uses the larger one
  int collision_group =
      -1;                // bodies of one group >= 0 do not collide with each other; -1: no group
  bool collides = true;  // false: never touches anything
  std::optional<std::uint32_t> color;  // 0xRRGGBB, display only; none: the view's default
};

/// Velocity and angular velocity, world [m/s, rad/s].
Vec6 velocity_of(const Body& body);

/// Upper bound on the acceleration of any point due to the body's constant force and torque
/// [m/s^2]; 0 for a static body. Clamped to 1e9 to keep derived values finite.
double fastest_gain(const Body& body);

/// Upper bound on the speed of any of its points [m/s]. @param u velocity, angular velocity
double fastest_point(const Body& body, const Vec6& u);

}  // namespace substep
