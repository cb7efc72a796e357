#pragma once

#include <cstdint>

#include "core/constraints/block.hpp"
#include "core/constraints/joint_geometry.hpp"
#include "core/math/turn.hpp"

namespace substep {

/// The motion of a sub-step, as integrate() will make it. @param u [m/s, rad/s]  @param dt [s]
inline Motion motion(const Vec6& u, double dt) {
  return {dt * u.head<3>(), turn_matrix(0.5 * dt * u.tail<3>())};
}

/// phi and J of a block after its bodies have moved: for solvers that look at the end of a sub-step
/// instead of its start. Exact for joints and for points on faces; spheres on spheres to the second
/// order of H.
/// @param moved out: J and phi of the rows asked for, the arms, axes, normal and tangents they
/// stand
///        on. phi is that after LESS that before; friction counts the way slid. The rest stays.
void move_rows(const Block& start, const Motion& a, const Motion& b, Block& moved,
               RowRange rows = {});

/// phi of the rows of a joint after LESS that before. @param phi out, one per row
void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi);

/// phi of a contact's normal after LESS that before, as move_rows() has it.
double moved_gap(const Block& start, const Motion& a, const Motion& b);

/// Floating-point operations of move_rows for so many rows of a block.
std::int64_t move_flops(const Block& block, int rows);

}  // namespace substep
