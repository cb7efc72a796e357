#pragma once

#include <span>
#include <vector>

#include "core/stepping/substep.hpp"

namespace substep {

// Forces of the last sub-step: they initialise contacts and warm starts, and keep the elastic part
// of springs.

/// True if forces of any constraint are stored.
bool forces_are_stored(const Substep& sub);

/// Sets the seed of each block to the force that was stored for it.
void seed_forces(const Substep& sub, const State& state, std::span<const StoredForce> of_last);

/// Appends the forces of the sub-step.
void store_forces(const Substep& sub, const State& state, std::vector<StoredForce>& out);

}  // namespace substep
