#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// The bias of every row: the speed at which its error is taken back.
///   full  phi/dt
///   soft  phi dt/tau^2 for dt < tau, else phi/dt
/// An open contact enters as gap/dt under both laws, so that a body does not stop early.
/// @param dt [s]
void set_drift_bias(std::span<Block> blocks, Drift law, double tau, double dt);

/// For the probe: no error is taken back, open contacts stay open. @param dt [s]
void set_probe_bias(std::span<Block> blocks, double dt);

}  // namespace substep
