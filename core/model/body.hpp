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

/// M^-1 of a body about its principal axes; zero for a static body.
struct InertiaInverse {
  double linear = 0.0;          // 1/m [1/kg]
  Vec3 angular = Vec3::Zero();  // 1/I [1/(kg m^2)]
  bool isotropic = true;        // equal principal moments
};

/// Velocity and angular velocity, world [m/s, rad/s].
Vec6 velocity_of(const Body& body);

/// Upper bound on the speed of any of its points [m/s]. @param u velocity, angular velocity
double fastest_point(const Body& body, const Vec6& u);

}  // namespace substep
