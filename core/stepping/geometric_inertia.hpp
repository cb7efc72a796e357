#pragma once

#include <algorithm>

namespace substep {

// With Mt replacing M on both sides, Mt (u+ - u) = -dt k x, a step is that of a body of mass Mt:
// slower rotation, no energy loss, stable while dt^2 k/Mt < 4 (see damping.hpp). In between, a
// share beta of the velocity term is taken with Mt and the rest with M,
//   Mt u+ = (beta Mt + (1 - beta) M) u - dt k x,
//   z^2 - (1 + kept - dt^2 k/Mt) z + kept = 0,   kept = beta + (1 - beta) M/Mt,
// its roots are within the unit circle (for kept = 1 on it) while the value at z = -1,
// 2 (1 + kept) - dt^2 k/Mt, is positive: dt^2 k < 2 (1 + kept) Mt. Their product is kept, so the
// decay factor per step is sqrt(kept).
// beta = 1 is `inertia`, beta = 0 the mass of damping.hpp. With the least Mt below, dt^2 k/Mt <=
// 4 alpha_m, the blend is stable for every k where alpha_m < (1 + beta)/2.

/// Geometric inertia: the least mass >= M with dt^2 k/Mt <= 4 alpha_m. Stable for every k where
/// alpha_m < 1. @param mass of the degree of freedom [kg m^2]  @param k [N m/rad]  @param dt [s]
inline double stiffened_mass(double mass, double k, double alpha_m, double dt) {
  return std::max(mass, dt * dt * k / (4.0 * alpha_m));
}

}  // namespace substep
