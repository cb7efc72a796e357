#pragma once

#include <span>

#include "core/constraints/block.hpp"

namespace substep {

/// Adds the derivative of the torque on each body by its own rotation, for a block's forces lambda:
/// the angular parts of the diagonal blocks of K (Eq. 1); for a contact, of its normal force. Equal
/// to StiffnessMatrix::angular(), without assembling the rest of K.
/// @param K per body, world axes [N m/rad]
void add_turning_stiffness(const Block& block, std::span<Mat3> K);

}  // namespace substep
