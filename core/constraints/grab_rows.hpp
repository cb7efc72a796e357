#pragma once

#include <limits>

#include "core/constraints/ball_joint.hpp"
#include "core/model/grab.hpp"

namespace substep {

/// Rows 0..2 as for a ball joint to the world, with the error clamped to Grab::kReach [m].
void grab_rows(const Grab& grab, const Side& body, Block& block);

/// Block::id of a grab's rows, distinct from all joints and contacts.
inline constexpr std::uint64_t kGrabId = std::numeric_limits<std::uint64_t>::max();
inline bool is_grab(const Block& block) { return block.id == kGrabId; }

/// Bias and softness of the damped spring k, c over a sub-step, implicitly:
///   lambda = -(k (phi + dt J u+) + c J u+), hence with impulse = dt lambda
///   J u+ + impulse / (dt (c + dt k)) = -k phi / (c + dt k).
/// @param dt [s]
void soften_grab(const Grab& grab, double dt, Block& block);

}  // namespace substep
