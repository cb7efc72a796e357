#include <algorithm>

#include "core/model/settings.hpp"

namespace substep {

// With Mt replacing M on both sides, Mt (u+ - u) = -dt k x, a step is that of a body of mass Mt:
// slower rotation, no energy loss, stable while dt^2 k/Mt < 4 (see damping.cpp). In between, a
// share beta of the velocity term is taken with Mt and the rest with M,
//   Mt u+ = (beta Mt + (1 - beta) M) u - dt k x,
//   z^2 - (1 + kept - dt^2 k/Mt) z + kept = 0,   kept = beta + (1 - beta) M/Mt,
// its roots are within the unit circle (for kept = 1 on it) while the value at z = -1,
// 2 (1 + kept) - dt^2 k/Mt, is positive: dt^2 k < 2 (1 + kept) Mt. Their product is kept, so the
// decay factor per step is sqrt(kept).
// beta = 1 is `inertia`, beta = 0 the mass of damping.cpp. With the least Mt below, dt^2 k/Mt <=
// 4 alpha_m, the blend is stable for every k where alpha_m < (1 + beta)/2.

// Geometric inertia: the least mass >= M with dt^2 k/Mt <= 4 alpha_m. Stable for every k where
// alpha_m < 1.
double stiffened_mass(const Settings& settings, double M, double k, double dt) {
  return std::max(M, dt * dt * k / (4.0 * settings.alpha_m));
}

}  // namespace substep
