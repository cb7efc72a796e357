#pragma once

#include "core/math/types.hpp"

namespace substep {

// The rotation of a body in a sub-step, to fourth order. In world axes only torques change its
// angular momentum. Störmer's sub-steps carry l, with (stormer.cpp, with L for q')
//   L(t) = L_m + t tau_m + t^2/2 tau',   L_m = l + dt^2/24 tau',   t from the middle on,
// and the body rotates by the exponential of Magnus' expansion, in body axes,
//   Omega = dt w + dt^3/24 w'' + dt^3/12 w x w',
//   I w = R_m^T L_m,  I w' = (I w) x w + R_m^T tau_m,  and w'' by differentiating once more, all at
//   the middle. R_m follows from the start by half the rotation,
//   Omega_h = dt/2 w - dt^2/8 w' + dt^3/48 w'' + dt^3/96 w x w',
// so that w is found by iteration; each iteration gains one order in the rotation angle.

/// @param I principal moments [kg m^2]  @param l carried angular momentum [N m s]
/// @param torque in the middle, tau_m [N m]  @param torque_change dt tau' [N m]
/// @return Omega [rad]. All about the principal axes at the start of the sub-step.
Vec3 free_turn(const Vec3& I, const Vec3& l, const Vec3& torque, const Vec3& torque_change,
               double dt);

}  // namespace substep
