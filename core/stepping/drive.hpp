#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/model/joint.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

// Rows of drives; compliance.hpp derives their weights. With the bounds +-effort t on the impulse
//   p = -t (k (mean of phi) + c (mean speed - v)),   phi = x - target.

/// Sets bias, softness and bounds of the row, and its coordinate.
/// @param u velocities of the last sub-step [m/s, rad/s]
void set_drive(const Substep& sub, const State& state, const Drive& drive, std::span<const Vec6> u,
               Block& row);

/// The same for what a drive changes of the velocities at the poses of its row.
/// @param time duration of its force [s]
void set_drive_reaction(const Substep& sub, const Drive& drive, double time, Block& row);

/// Largest torque or force of a drive at a speed of its coordinate [N m or N].
double effort_at(const Drive& drive, double coordinate, double speed);

/// Sets bias, softness and bounds of a row of dry friction: its impulse opposes the motion that the
/// row stops if it can. The softness, 1e-9 of the mobility of the row, lets redundant rows of a
/// loop share a force; it acts on the change of the impulse alone, so that nothing
/// creeps but by the scene's regularisation.
/// @param effort largest torque or force [N m or N]  @param time duration of the impulse [s]
void set_joint_friction(const Substep& sub, double effort, double time, Block& row);

}  // namespace substep
