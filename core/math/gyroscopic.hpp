#pragma once

#include "core/math/types.hpp"

namespace substep {

// A body turns by the Cayley map of its angular velocity w (see integrate), which stays the same in
// the body's axes throughout a sub-step. With the momentum I w of its middle, those of its ends are
//   p- = I w - dt/2 (I w) x w   and   p+ = I w + dt/2 (I w) x w,
// each in the body's axes of that time: turned into the world they are equal, whatever the steps.
// That is the implicit midpoint rule for p' = p x I^-1 p, which keeps |p| and p . I^-1 p exactly.
// Between two sub-steps torques act on p, at the pose that both share: so angular momentum is
// conserved to rounding, and the whole is of second order, with joints too.

/// (I w) x w, what a body does to itself. @param I principal moments [kg m^2]  @param w about the
/// principal axes [rad/s]  @return [N m]
inline Vec3 gyroscopic_torque(const Vec3& I, const Vec3& w) { return I.cwiseProduct(w).cross(w); }

/// p+, at the end of a sub-step. All about the principal axes. @return [N m s]
inline Vec3 momentum_after(const Vec3& I, const Vec3& w, double dt) {
  return I.cwiseProduct(w) + 0.5 * dt * gyroscopic_torque(I, w);
}

/// The w of a sub-step that begins with the momentum p. Newton's method, which arrives while the
/// body turns by less than about a radian a step; beyond, the result is its last iterate.
/// @param p [N m s]  @param guess [rad/s]  @param dt negative: p is that of its end [s]
Vec3 velocity_of_momentum(const Vec3& I, const Vec3& p, double dt, const Vec3& guess);

/// Explicit Euler: w + dt I^-1 ((I w) x w). Gains energy.
Vec3 gyroscopic_explicit(const Vec3& I, const Vec3& w, double dt);

}  // namespace substep
