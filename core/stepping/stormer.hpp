#pragma once

#include <cstdint>
#include <span>

#include "core/constraints/moved_rows.hpp"
#include "core/math/types.hpp"

namespace substep {

// Störmer's fourth-order method (1907), one solve per sub-step:
//   q+ - 2 q + q- = dt^2/12 (14 a - 5 a- + 4 a-- - a---).
// It is leapfrog, u+ = u + dt a, with poses corrected for the change of acceleration: with
// D = a - a-,
//   q+ = q + dt w,   w = u+ + dt/12 (2 D - D-).
// On the model of Eq. 5 it is stable while dt^2 k < 2 M, and damps motion near that limit. The
// constraints must hold at q+. With a = (u+ - u)/t (t: duration of forces, dt) w is linear in u+:
//   w = g u+ + known terms,   g = 1 + dt/(6 t),
// and the rows, linearised about the poses q^ extrapolated with the last change of acceleration,
// w^ = w(u^), become
//   phi(q^)/dt + J (w - w^) = 0,   or   J u+ - J u^ + phi(q^)/(g dt) = 0.
// If dt differs from the previous dt-, the changes are scaled (D and D- by dt/dt-, hence
// g = 1 + dt/dt- dt/(6 t)), and the dt^2 term omitted from the velocities is corrected:
//   u = q' - dt^2/24 a'  in the middle of a sub-step, so that  u += (dt^2 - dt-^2)/12 a'.
// Rotations do not commute: by Magnus' expansion a body with changing angular velocity rotates by
// dt w + dt^3/12 w' x w in world axes. (For tumbling bodies see free_turn.hpp.) The Cayley vector
// of integrate() is dt w/2; that of a rotation by dt |w| is longer by a relative (dt |w|/2)^2/3.

/// dt/dt-. In the first sub-step, changes refer to a trial sub-step of the same length.
/// @param time t, that forces act for: (dt- + dt)/2 [s]
inline double stormer_growth(double dt, double time) {
  if (time == dt) return 1.0;
  const double before = 2.0 * time - dt;
  return before > 0.0 ? dt / before : 1.0;
}

/// Velocity correction for a change of step length, as a factor on the change of acceleration per
/// previous sub-step [s]; likewise for momentum and torque.
/// @param time t, that forces act for: (dt- + dt)/2 [s]
inline double stormer_step_change(double dt, double time) {
  const double before = 2.0 * time - dt;
  return before > 0.0 ? (dt * dt - before * before) / (12.0 * before) : dt / 12.0;
}

/// The velocity that moves a body's pose. @param u, u_before after this sub-step's impulses and
/// before its forces  @param time duration of the forces [s]  @return w [m/s, rad/s]
Vec6 stormer_velocity(const Vec6& u, const Vec6& u_before, const Vec6& acceleration,
                      const Vec6& acceleration_change, double dt, double time);

/// Makes the drift correction and softness of joints refer to the poses at the end of the sub-step.
/// @param acceleration, u_guess per body: a- and u^  @param motions per body: by w^, in dt
/// @param times per body [s]
void aim_at_stormer_poses(std::span<Block> blocks, std::span<const Vec6> acceleration,
                          std::span<const Vec6> u_guess, std::span<const Motion> motions,
                          std::span<const double> times, double dt);

/// Floating-point operations of both functions.
std::int64_t stormer_flops(std::span<const Block> blocks, std::size_t bodies);

}  // namespace substep
