#pragma once
// The table of applied forces: forces that act on bodies from outside, one effect each. A force is
// one struct of static functions in its own file, and one entry of AppliedForces; a missing
// function is a compile error.

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <tuple>
#include <type_traits>

#include "core/forces/constant_force.hpp"
#include "core/forces/gravity.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Interface of an applied force. Bodies are moving ones.
template <class F>
concept AppliedForce = requires(const Scene& scene, const Body& body, const InertiaInverse& own,
                                const Mat3& R_WB, double time, Vec6& u, const Vec3& x) {
  { F::kEffect } -> std::convertible_to<bool Effects::*>;
  // u += time M^-1 (force, torque), world axes. own: M^-1; time: duration of the force [s].
  { F::accelerate(scene, body, own, R_WB, time, u) } -> std::same_as<void>;
  // Potential energy of the body with its centre at x [J].
  { F::potential(scene, body, x) } -> std::same_as<double>;
  // Upper bound on the acceleration of any of its points due to the force [m/s^2].
  { F::acceleration_bound(scene, body) } -> std::same_as<double>;
};

using AppliedForces = std::tuple<Gravity, ConstantForce>;

static_assert([]<class... F>(std::type_identity<std::tuple<F...>>) {
  return (AppliedForce<F> && ...);
}(std::type_identity<AppliedForces>{}));

/// Calls `visit` with each force of the table whose effect is enabled.
template <class Visit>
void for_each_force(const Effects& effects, Visit&& visit) {
  [&]<class... F>(std::type_identity<std::tuple<F...>>) {
    ((effects.*F::kEffect ? visit(F{}) : void()), ...);
  }(std::type_identity<AppliedForces>{});
}

/// True if the effect `external` applies a constant torque to a body.
inline bool has_torque(const Scene& scene) {
  return scene.effects.external &&
         std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& body) { return !body.is_static && !body.torque.isZero(0.0); });
}

/// True if torques that have no potential do work: energy may then grow.
inline bool is_driven(const Scene& scene) {
  return scene.effects.motors || scene.effects.drives || has_torque(scene);
}

/// True if applied forces other than the known ones act on bodies.
inline bool has_applied_forces(const Effects& effects,
                               std::initializer_list<bool Effects::*> known = {}) {
  Effects other = effects;
  for (bool Effects::*const effect : known) other.*effect = false;
  bool found = false;
  for_each_force(other, [&](auto) { found = true; });
  return found;
}

/// Upper bound on the acceleration of any point of a body due to applied forces [m/s^2]; 0 for a
/// static body. Clamped to 1e9 to keep derived values finite.
inline double acceleration_bound(const Scene& scene, const Body& body) {
  if (body.is_static) return 0.0;
  constexpr double kMost = 1e9;  // [m/s^2]
  double bound = 0.0;
  for_each_force(scene.effects,
                 [&](auto force) { bound += force.acceleration_bound(scene, body); });
  return bound < kMost ? bound : kMost;  // NaN also becomes kMost
}

}  // namespace substep
