#pragma once

#include <cstdint>

#include "core/constraints/block.hpp"
#include "core/constraints/contact.hpp"

namespace substep {

/// Floating-point operations of adding one block to K, as the files beside this one do it.
/// @param terms of a contact
std::int64_t stiffness_flops(const Block& block, ContactTerms terms);

/// The same of add_turning_stiffness().
std::int64_t turning_stiffness_flops(const Block& block);

}  // namespace substep
