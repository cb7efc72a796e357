#pragma once

#include <span>

#include "core/model/body.hpp"
#include "core/model/part.hpp"
#include "core/model/state.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

/// Advances the poses with u+, or what an integrator uses instead: x += dt v, and q rotated by the
/// Cayley map of dt omega, the normalised quaternion (1, dt omega/2). It needs only sqrt, and
/// velocity_of_momentum() requires it to conserve angular momentum.
/// @param u per body [m/s, rad/s]
void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state);

/// Turns the velocity of a tumbling body with its axes. @param turn world
using TurnSpin = void(const Substep& sub, std::size_t body, const Quat& turn, State& state);
/// For a velocity that belongs to the middle of a sub-step. See turn_momentum() for one of its
/// start.
TurnSpin turn_spin;

/// The same for the bodies of a sub-step, with u + Substep::shift. A tumbling body keeps its spin
/// about its own axes, so that the shift changes no kinetic energy.
void integrate(const Substep& sub, std::span<const Vec6> u, TurnSpin* turn, State& state);

/// Computes R_WB of some bodies from their poses. @param R_WB per body of the scene
void rotation_matrices(std::span<const int> bodies, const State& state, std::span<Mat3> R_WB);

/// Upper bound on twice a body's kinetic energy [J]; finite only if its velocity is.
double most_kinetic(const Body& body, const Vec6& u);

/// Replaces a synchronised velocity by u if it is not finite: gyroscopic torques are quadratic in
/// speed and may overflow first.
void keep_finite(const Body& body, const Vec6& u, Vec6& synchronised);

}  // namespace substep
