#pragma once

#include <cstdint>

#include "core/constraints/moved_rows.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

/// True if friction rows are held in the middle of a sub-step, as below.
bool aims_rolling(const Settings& settings);

/// The velocity of a sub-step is that of its middle, where rolling bodies touch in other points and
/// directions than at its start. The friction rows of contacts that stick hold the sliding of these
/// points, predicted with the velocities before the forces:
///   J u+ + (s^/dt - J u^) = 0,   s^ the sliding distance of the motion u^.
/// Without it rolling on a curved surface is of first order. Not with the paper's friction box,
/// which keeps its results, nor for solvers that hold rows at the end of a sub-step.
/// @param motions scratch, of all bodies  @return operations
std::int64_t aim_rolling(const Substep& sub, Motions& motions);

}  // namespace substep
