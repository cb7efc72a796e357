#pragma once

#include "core/constraints/ball_joint.hpp"
#include "core/model/grab.hpp"

namespace substep {

/// Rows 0..2 as those of a ball joint to the world, the error no longer than the hand's reach [m].
void grab_rows(const Grab& grab, const Side& body, Block& block);

/// Whether these are the rows of a hand.
bool is_grab(const Block& block);

/// Bias and softness of the damped spring k, c over a sub-step, implicitly:
///   lambda = -(k (phi + dt J u+) + c J u+), hence with impulse = dt lambda
///   J u+ + impulse / (dt (c + dt k)) = -k phi / (c + dt k).
/// @param dt [s]
void soften_grab(const Grab& grab, double dt, Block& block);

}  // namespace substep
