#pragma once

#include <cstdint>
#include <span>

#include "core/constraints/moved_rows.hpp"
#include "core/math/types.hpp"

namespace substep {

// Störmer's method of fourth order (1907), one solve a sub-step:
//   q+ - 2 q + q- = dt^2/12 (14 a - 5 a- + 4 a-- - a---).
// It is leapfrog, u+ = u + dt a, whose poses take in how the accelerations change: with D = a - a-,
//   q+ = q + dt w,   w = u+ + dt/12 (2 D - D-).
// On the model of Eq. 5 it is stable while dt^2 k < 2 M, and damps what is near that. The
// constraints are to hold at q+. With a = (u+ - u)/t (t: how long forces act, dt) w is linear in
// u+:
//   w = g u+ + what is known,   g = 1 + dt/(6 t),
// and the rows, linearised about the poses q^ where accelerations that go on changing as they did
// would lead, w^ = w(u^), become
//   phi(q^)/dt + J (w - w^) = 0,   or   J u+ - J u^ + phi(q^)/(g dt) = 0.
// Where dt is another than that of the sub-step before, dt-, changes are taken in proportion (D and
// D- by dt/dt-, and with them g = 1 + dt/dt- dt/(6 t)), and what velocities leave out, which goes
// with dt^2, is handed over:
//   u = q' - dt^2/24 a'  in the middle of a sub-step, so that  u += (dt^2 - dt-^2)/12 a'.
// Turns do not commute: by Magnus' expansion a body whose angular velocity changes turns, in world
// axes, by dt w + dt^3/12 w' x w. (Of what tumbles, free_turn.hpp.) The Cayley vector of
// integrate() is dt w/2, that of a turn by dt |w| longer by (dt |w|/2)^2/3.

/// dt/dt-. Where there was no sub-step before, changes are those of a trial one as long as this.
/// @param time t, that forces act for: (dt- + dt)/2 [s]
inline double stormer_growth(double dt, double time) {
  if (time == dt) return 1.0;
  const double before = 2.0 * time - dt;
  return before > 0.0 ? dt / before : 1.0;
}

/// What is added to a velocity where sub-steps change their length, of how its acceleration changes
/// in a sub-step as long as the one before [s]; to a momentum, of its torque.
/// @param time t, that forces act for: (dt- + dt)/2 [s]
inline double stormer_step_change(double dt, double time) {
  const double before = 2.0 * time - dt;
  return before > 0.0 ? (dt * dt - before * before) / (12.0 * before) : dt / 12.0;
}

/// What the poses of a body move by. @param u, u_before after this sub-step's impulses and before
/// its forces  @param time that forces acted for [s]  @return w [m/s, rad/s]
Vec6 stormer_velocity(const Vec6& u, const Vec6& u_before, const Vec6& acceleration,
                      const Vec6& acceleration_change, double dt, double time);

/// Turns the drift correction of joints into one that aims at the poses of the end of the sub-step,
/// and their softness with it.
/// @param acceleration, u_guess per body: a- and u^  @param motions per body: by w^, in dt
/// @param times per body [s]
void aim_at_stormer_poses(std::span<Block> blocks, std::span<const Vec6> acceleration,
                          std::span<const Vec6> u_guess, std::span<const Motion> motions,
                          std::span<const double> times, double dt);

/// Floating-point operations of both for so many bodies.
std::int64_t stormer_flops(std::span<const Block> blocks, std::size_t bodies);

}  // namespace substep
