#pragma once

#include <cstdint>

#include "core/constraints/block.hpp"
#include "core/constraints/contact.hpp"

namespace substep {

inline constexpr std::int64_t kSkewProductFlops = 12;  // skew_product()
inline constexpr std::int64_t kSumFlops = 9;           // of two 3 x 3 matrices

/// Floating-point operations of adding one block to K.
/// @param terms of a contact
std::int64_t stiffness_flops(const Block& block, ContactTerms terms);

/// The same of add_turning_stiffness().
std::int64_t turning_stiffness_flops(const Block& block);

}  // namespace substep
