#pragma once

#include <span>

#include "core/constraints/block.hpp"

namespace substep {

/// Adds what a block's forces, lambda, do to the torque on each of its bodies as that body turns:
/// the angular parts of the diagonal blocks of K (Eq. 1), of a contact those of its normal force.
/// Equal to StiffnessMatrix::angular(), without the rest of K.
/// @param K per body, world axes [N m/rad]
void add_turning_stiffness(const Block& block, std::span<Mat3> K);

}  // namespace substep
