#pragma once

#include <span>

#include "core/model/part.hpp"
#include "core/model/settings.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Advances the poses with u+ or its substitute (stormer.hpp): x += dt v, and q rotated by the
/// Cayley map of dt omega, the normalised quaternion (1, dt omega/2). It needs only sqrt, and
/// gyroscopic_implicit requires it to conserve angular momentum.
/// @param u per body [m/s, rad/s]
void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state);

/// Duration of external forces in a sub-step. Euler: dt. Leapfrog and Störmer: from the middle of
/// the last sub-step to the middle of this one, (dt_previous + dt)/2, with dt_previous = 0 at the
/// start. [s]
inline double force_time(Integrator integrator, double dt_previous, double dt) {
  return integrator == Integrator::kEuler ? dt : 0.5 * (dt_previous + dt);
}

}  // namespace substep
