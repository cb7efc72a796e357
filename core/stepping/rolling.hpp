#pragma once

#include <cstdint>

#include "core/stepping/substep.hpp"

namespace substep {

/// The velocity of a sub-step is that of its middle, where rolling bodies touch in other points and
/// directions than at its start. The friction rows of contacts that stick hold the sliding of these
/// points, predicted with the velocities before the forces:
///   J u+ + (s^/dt - J u^) = 0,   s^ the sliding distance of the motion u^.
/// Without it rolling on a curved surface is of first order. Not for solvers that hold rows at the
/// end of a sub-step. @return operations
std::int64_t aim_rolling(const Substep& sub);

}  // namespace substep
