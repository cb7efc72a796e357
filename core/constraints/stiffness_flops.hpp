#pragma once

#include <cstdint>

#include "core/constraints/block.hpp"

namespace substep {

/// Floating-point operations of adding one block to K, as the files beside this one do it.
/// @param exact_contact the true derivative of a contact in the place of the paper's block
std::int64_t stiffness_flops(const Block& block, bool exact_contact);

}  // namespace substep
