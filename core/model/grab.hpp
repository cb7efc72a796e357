#pragma once

#include "core/math/types.hpp"

namespace substep {

struct Scene;

/// Pulls a point of a body towards a point in the world by a damped spring (mouse joint). Its
/// length is limited to kReach, which bounds the force relative to the mass.
struct Grab {
  static constexpr double kRate = 7.0;     // undamped, sqrt(stiffness/mass) [rad/s]
  static constexpr double kDamping = 0.6;  // fraction of critical damping [-]
  static constexpr double kReach = 0.8;    // maximum spring length [m]

  int body = 0;                // index into Scene::bodies, moving
  Vec3 anchor = Vec3::Zero();  // grabbed point, body frame [m]
  Vec3 target = Vec3::Zero();  // target point, world [m]
  double mass = 1.0;           // mass for stiffness and damping [kg]

  [[nodiscard]] double stiffness() const { return mass * kRate * kRate; }         ///< [N/m]
  [[nodiscard]] double damping() const { return 2.0 * kDamping * kRate * mass; }  ///< [N s/m]
};

/// Mass of a body and all bodies joined to it [kg].
double joined_mass(const Scene& scene, int body);

}  // namespace substep
