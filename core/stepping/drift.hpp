#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// The bias of every row: the speed at which its error is taken back.
///   full  phi/dt
///   soft  phi dt/tau^2 for dt < tau, else phi/dt
/// An open contact enters as gap/dt under both laws, so that a body does not stop early. What of a
/// closed one's phi is its compliance's own, Block::elastic, is no error: phi - elastic is taken
/// back. Springs of joints come after it: compliance.hpp. @param dt [s]
void set_drift_bias(std::span<Block> blocks, Drift law, double tau, double dt);

/// The speed of either law at which an error goes, in parts of it [1/s].
double drift_rate(Drift law, double tau, double dt);

/// Second order: a sub-step is solved with the gradients at its start, while the joints' rows
/// curve,
///   phi(dt) = phi + dt J u + dt^2/2 phi'' + ...,
/// so that what was solved leaves dt^2/2 phi'' for the next correction to find. This adds
/// dt/2 phi'' to the bias of every joint, phi'' as the bodies turned when the sub-step began.
/// It feeds on velocities: where those are noisy, as under soft or redundant joints, it is noise.
/// @param u velocities at the start of the sub-step  @param dt [s]
void add_curvature_bias(std::span<Block> blocks, std::span<const Vec6> u, double dt);

/// J a = -phi'' for joints: the accelerations a that keep their velocities. Compliant rows are
/// springs that push with -phi/C where sub-steps of dt resolve them, else they hold as rigid ones
/// do.
/// @param u velocities [m/s, rad/s]  @param regularisation [1/kg]
void set_acceleration_rows(std::span<Block> joints, std::span<const Vec6> u,
                           std::span<const InverseMass> inverse_mass, double dt,
                           double regularisation);

/// For the probe: no error is taken back, open contacts stay open. @param dt [s]
void set_probe_bias(std::span<Block> blocks, double dt);

}  // namespace substep
