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

/// Second order: a sub-step is solved with the gradients at its start, while the joints' rows
/// curve,
///   phi(dt) = phi + dt J u + dt^2/2 phi'' + ...,
/// so that what was solved leaves dt^2/2 phi'' for the next correction to find. This adds
/// dt/2 phi'' to the bias of every joint, phi'' as the bodies turned when the sub-step began.
/// It feeds on velocities: where those are noisy, as under soft or redundant joints, it is noise.
/// @param u velocities at the start of the sub-step  @param dt [s]
void add_curvature_bias(std::span<Block> blocks, std::span<const Vec6> u, double dt);

/// For the probe: no error is taken back, open contacts stay open. @param dt [s]
void set_probe_bias(std::span<Block> blocks, double dt);

}  // namespace substep
