#pragma once

#include "core/math/types.hpp"

namespace substep {

/// Torque-free change of the angular velocity of a body from the middle of the last sub-step to the
/// middle of this one, principal axes: the angular momentum at the time between them is
///   p = I w + dt_before/2 (I w) x w = I w' - dt/2 (I w') x w',
/// an explicit half step and an implicit one. Turning the body by the Cayley map of w' (see
/// integrate) then keeps angular momentum and rotational energy at p exactly, whatever the steps.
/// Solved by Newton's method, which arrives while the body turns by less than about a radian a
/// step; beyond, the result is its last iterate.
/// @param I principal moments [kg m^2]  @param w [rad/s]  @return w' [rad/s]
Vec3 gyroscopic_implicit(const Vec3& I, const Vec3& w, double dt_before, double dt);

/// Explicit Euler: w + dt I^-1 ((I w) x w). Gains energy.
Vec3 gyroscopic_explicit(const Vec3& I, const Vec3& w, double dt);

}  // namespace substep
