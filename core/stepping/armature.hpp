#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

// An armature a adds a q'^2/2 to the kinetic energy, q the coordinate of its joint. It exerts
//   -a q'' = -d(a q')/dt
// along the coordinate: between the rates q'- before and q'+ after the sub-step, an impulse
//   p = -a (q'+ - q'-),   the row   J u+ + p/a = q'- - (q'+ - J u+).
// Rates are those of the middles of sub-steps, u+ belongs to the next one and J to the poses at its
// start: q'+ = J u+ + dt/2 (dJ/dt) u, which matters for slides of bodies that rotate. q'- is
// carried from the last sub-step, so that a q' changes by p alone. J u instead, with u the velocity
// of the last sub-step and J the gradient of this one, would be too small for hinges whose axis
// rotates: energy would be lost at first order. Solvers that hold rows at the end of the sub-step,
// and Störmer, read q'+ from the poses.

/// Sets bias, softness and bounds of the row, and the rate before the sub-step in Block::elastic.
/// @param u velocities of the last sub-step, after impacts [m/s, rad/s]
void set_armature(const Substep& sub, std::span<const Vec6> u, Block& row);

/// The same where no time passes: for impacts, and for what forces change until the poses.
/// @param rate before [rad/s or m/s]
void set_armature_at_rate(double rate, double regularisation, Block& row);

/// The rate before the sub-step, without its impacts [rad/s or m/s].
double rate_before(const Substep& sub, const Block& row);

/// The rate after the sub-step, by the row's law: for StoredForce [rad/s or m/s].
double rate_after(const Substep& sub, const Block& row);

/// Mobility of the coordinate of a row, armature included [1/(kg m^2) or 1/kg].
double mobility_along(const Substep& sub, const Block& row);

}  // namespace substep
