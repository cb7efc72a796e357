#pragma once

#include "core/math/types.hpp"

namespace substep {

struct Scene;

/// A hand that pulls a point of a body towards a point in the world: a damped spring that reaches
/// no farther than kReach, so that the force stays within what the mass behind it bears.
struct Grab {
  static constexpr double kRate = 7.0;     // undamped, sqrt(stiffness/mass) [rad/s]
  static constexpr double kDamping = 0.6;  // of the critical one [-]
  static constexpr double kReach = 0.8;    // of the spring [m]

  int body = 0;                // index into Scene::bodies, moving
  Vec3 anchor = Vec3::Zero();  // where it is held, body frame [m]
  Vec3 target = Vec3::Zero();  // where it is pulled to, world [m]
  double mass = 1.0;           // that stiffness and damping are made for [kg]

  [[nodiscard]] double stiffness() const { return mass * kRate * kRate; }         ///< [N/m]
  [[nodiscard]] double damping() const { return 2.0 * kDamping * kRate * mass; }  ///< [N s/m]
};

/// Mass that moves with a body: its own and that of all it is joined to [kg].
double joined_mass(const Scene& scene, int body);

}  // namespace substep
