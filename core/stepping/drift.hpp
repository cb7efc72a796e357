#pragma once

#include <functional>
#include <span>

#include "core/constraints/block.hpp"
#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

struct Substep;

/// The bias of every row: the speed of its drift correction.
///   full  phi/dt
///   soft  phi dt/tau^2 for dt < tau, else phi/dt
/// An open contact has bias gap/dt under both laws, so that a body does not stop early. The elastic
/// part of a closed contact's phi, Block::elastic, is not drift: only phi - elastic is corrected.
/// Joint springs are set afterwards: compliance.hpp. In a sub-step that an impact shortens, a joint
/// under the law full has phi/planned_dt: its gap must not become speed.
/// @param dt [s]  @param planned_dt >= dt [s]
void set_drift_bias(std::span<Block> blocks, Drift law, double tau, double dt, double planned_dt);

/// Relative rate of the drift correction under either law [1/s].
double drift_rate(Drift law, double tau, double dt);

/// phi'' of the rows of a joint or a coordinate at constant velocities.
/// @param u per body [m/s, rad/s]  @param curvature out, kMaxRows [m/s^2, 1/s^2]
void curvature_of(const Block& block, std::span<const Vec6> u, double* curvature);

/// Second-order correction. A sub-step is solved with the gradients at its start, but joint rows
/// are curved,
///   phi(dt) = phi + dt J u + dt^2/2 phi'' + ...,
/// so that the solution leaves an error dt^2/2 phi''. This adds dt/2 phi'' to the bias of every
/// joint, with phi'' from the velocities at the start of the sub-step. Noisy velocities, as with
/// soft or redundant joints, make the correction noisy.
/// @param u velocities at the start of the sub-step  @param dt [s]
void add_curvature_bias(std::span<Block> blocks, std::span<const Vec6> u, double dt);

/// Sets up J a = -phi'' for joints: accelerations a consistent with their velocity constraints.
/// Compliant rows exert -phi/C if sub-steps of dt resolve them, and are rigid otherwise.
/// @param u velocities [m/s, rad/s]  @param regularisation [1/kg]
void set_acceleration_rows(std::span<Block> joints, std::span<const Vec6> u,
                           std::span<const InverseMass> inverse_mass, double dt,
                           double regularisation);

/// Sum of the speeds of the bodies of a contact, of their centres of mass [m/s], or of a limit, of
/// their rotation or centres [rad/s or m/s]. @param u per body: velocities, or their changes by
/// forces [m/s, rad/s]
double speeds_of(const Block& row, std::span<const Vec6> u);

/// The largest speed that the forces of a sub-step cause along the row of a contact [m/s], or of a
/// limit, whose bodies motors, drives and joints push too [rad/s or m/s].
double speed_by_forces(const Substep& sub, const Block& row);

/// For contacts that are found along the motion: an overlap is not corrected by velocities, and the
/// softness, reduced under a load, acts on the change of the force alone. Bodies would sink with
/// the softness times the force. The impulses are those of the last sub-step.
/// The small gap of a contact that rests must not become a fall in a sub-step that an impact
/// shortens.
/// @param gain per body: velocity by the forces of the sub-step [m/s, rad/s]  @param shift of the
/// motion, Substep::shift
/// @param dt, planned_dt as above [s]  @param is_deep whether an overlap is more than bodies sink
void set_swept_bias(std::span<Block> blocks, std::span<const Vec6> gain,
                    std::span<const Vec6> shift, double dt, double planned_dt,
                    const std::function<bool(const Block&)>& is_deep);

/// For the probe: no drift correction; open contacts stay open. @param dt [s]
void set_probe_bias(std::span<Block> blocks, double dt);

}  // namespace substep
