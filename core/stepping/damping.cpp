#include <algorithm>

#include "core/model/settings.hpp"

namespace substep {

// A degree of freedom with mass M and a spring k, as semi-implicit Euler steps it (Eq. 5's model):
//   u+ = u - dt k x / M,  x+ = x + dt u+,  so  u++ - (2 - kappa) u+ + u = 0,  kappa = dt^2 k/M.
// The roots leave the unit circle at kappa = 4. With a mass Mt replacing M on the left alone,
//   Mt u+ = M u - dt k x,  gives  z^2 - (1 + M/Mt - dt^2 k/Mt) z + M/Mt = 0,
// whose roots stay within it while dt^2 k <= 2 (M + Mt), with decay factor sqrt(M/Mt) per step.
// Leapfrog at constant dt has the same recurrence, with u half a step earlier.
//
// `none` and `const` keep M and the user's dt: stable while kappa < 4. `adaptive` keeps M and
// chooses dt <= 2 sqrt(alpha M/k) (Eqs. 10 and 11), so that kappa <= 4 alpha: stable for alpha < 1.
// `capped` limits N to n_cap and damps the remaining stiffness: `damping` with dt = h/n_cap.

// Adaptive damping (Andrews et al. 2017; Eq. 6): Mt = M + dt b with
// b = max(0, (dt^2 k - 4 alpha M)/dt). Stable for every k and alpha <= 1: where b > 0,
// 2 (M + Mt) - dt^2 k = dt^2 k + 4 M (1 - 2 alpha) > 4 M (1 - alpha).
double damped_mass(const Settings& settings, double M, double k, double dt) {
  return M + std::max(0.0, dt * dt * k - 4.0 * settings.alpha * M);
}

}  // namespace substep
