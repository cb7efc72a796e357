#pragma once

#include <span>

#include "core/model/part.hpp"
#include "core/model/settings.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Poses forward with u+, or what stands for it (stormer.hpp): x += dt v, and q turned by the
/// Cayley map of dt omega, which is the quaternion (1, dt omega/2) normalised: no function beyond
/// sqrt, and what gyroscopic_implicit needs to conserve angular momentum.
/// @param u per body [m/s, rad/s]
void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state);

/// How long external forces act in a sub-step. Euler: dt. Leapfrog and Störmer: from the middle of
/// the last sub-step to the middle of this one, (dt_previous + dt)/2, with dt_previous = 0 at the
/// start. [s]
inline double force_time(Integrator integrator, double dt_previous, double dt) {
  return integrator == Integrator::kEuler ? dt : 0.5 * (dt_previous + dt);
}

}  // namespace substep
