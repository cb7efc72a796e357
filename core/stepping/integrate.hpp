#pragma once

#include <span>

#include "core/model/body.hpp"
#include "core/model/part.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Advances the poses with u+, or what an integrator uses instead: x += dt v, and q rotated by the
/// Cayley map of dt omega, the normalised quaternion (1, dt omega/2). It needs only sqrt, and
/// velocity_of_momentum() requires it to conserve angular momentum.
/// @param u per body [m/s, rad/s]  @param shift added to u; empty: none
void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state,
               std::span<const Vec6> shift = {});

/// Computes R_WB of some bodies from their poses. @param R_WB per body of the scene
void rotation_matrices(std::span<const int> bodies, const State& state, std::span<Mat3> R_WB);

/// Upper bound on twice a body's kinetic energy [J]; finite only if its velocity is.
double most_kinetic(const Body& body, const Vec6& u);

/// Replaces a synchronised velocity by u if it is not finite: gyroscopic torques are quadratic in
/// speed and may overflow first.
void keep_finite(const Body& body, const Vec6& u, Vec6& synchronised);

}  // namespace substep
