#pragma once

#include "core/math/types.hpp"

namespace substep {

// A body rotates by the Cayley map of its angular velocity w (see integrate), which is constant in
// body axes during a sub-step. With the momentum I w at the middle, the momenta at the ends are
//   p- = I w - dt/2 (I w) x w   and   p+ = I w + dt/2 (I w) x w,
// each in the body axes of that time: in world axes they are equal for any step. That is the
// implicit midpoint rule for p' = p x I^-1 p, which conserves |p| and p . I^-1 p exactly. Torques
// act on p between two sub-steps, at their common pose: angular momentum is conserved to rounding,
// and the scheme is second order, also with joints.

/// (I w) x w, the gyroscopic torque. @param I principal moments [kg m^2]  @param w about the
/// principal axes [rad/s]  @return [N m]
inline Vec3 gyroscopic_torque(const Vec3& I, const Vec3& w) { return I.cwiseProduct(w).cross(w); }

/// p+, at the end of a sub-step. All about the principal axes. @return [N m s]
inline Vec3 momentum_after(const Vec3& I, const Vec3& w, double dt) {
  return I.cwiseProduct(w) + 0.5 * dt * gyroscopic_torque(I, w);
}

/// The w of a sub-step that begins with the momentum p, by Newton's method. It converges for
/// rotations below about one radian per step; beyond, the result is the last iterate.
/// @param p [N m s]  @param guess [rad/s]  @param dt negative: p is at the end of the sub-step [s]
Vec3 velocity_of_momentum(const Vec3& I, const Vec3& p, double dt, const Vec3& guess);

/// Explicit Euler: w + dt I^-1 ((I w) x w). Gains energy.
Vec3 gyroscopic_explicit(const Vec3& I, const Vec3& w, double dt);

}  // namespace substep
