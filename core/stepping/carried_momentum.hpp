#pragma once

#include "core/stepping/substep.hpp"

namespace substep {

// Fourth-order sub-steps solve for the angular momentum l of tumbling bodies: their u is I^-1 l
// from begin() until settle_momentum().

/// l in the axes of the body at the start of a sub-step, without its forces [N m s].
Vec3 momentum_at_start(const Substep& sub, const State& state, std::size_t body);

/// The momentum of a body while its u is I^-1 l, world [N m s].
Vec3 momentum_of(const Substep& sub, std::size_t body, const Vec6& u);

/// I^-1 l [rad/s]; for a torque, its angular acceleration. @param l world
Vec3 velocity_of(const Substep& sub, std::size_t body, const Vec3& l);

/// Turns the momentum of a tumbling body, as TurnSpin.
void turn_momentum(const Substep& sub, std::size_t body, const Quat& turn, State& state);

/// Replaces I^-1 l by the angular velocity at the poses after the sub-step.
void settle_momentum(const Substep& sub, State& state);

/// The velocity at the poses, after `gained` in dt/2 [m/s, rad/s; N m s if it tumbles].
void synchronise_by(const Substep& sub, std::size_t body, const Vec6& gained, State& state);

}  // namespace substep
