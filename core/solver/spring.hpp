#pragma once

#include <cstddef>

#include "core/constraints/block.hpp"
#include "core/math/types.hpp"
#include "core/solver/symmetric6.hpp"

namespace substep {

/// Destination of springs between two bodies in a matrix of 6 x 6 blocks, row-major, as dt^2 times
/// stiffness [kg, kg m; kg m, kg m^2].
struct SpringTarget {
  Square6& A;           // of the body, on and below the diagonal
  double* B = nullptr;  // coupling block; nullptr without another moving body
  double* U = nullptr;  // of the other body, on and below the diagonal
  std::size_t stride = 0;
};

/// Free rows as springs of stiffness 1/s: J^T s^-1 J. Rows of joints are always free.
/// @param is_a true if the body is side a of the block
void add_springs(const Block& block, bool is_a, const SpringTarget& to);

/// The impulses of free rows, x = -(w + J v)/s.
/// @param w J u* + bias  @param a, b changes of velocity; nullptr for a static side
void spring_impulses(const double* w, const Vec6* a, const Vec6* b, Block& block);

}  // namespace substep
