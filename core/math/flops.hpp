#pragma once
// Floating-point operations of the solver kernels: additions, multiplications, divisions and roots
// count one each. They depend only on sizes, so they are machine-independent, and are counted at
// layout time at negligible cost.

#include <cstdint>

namespace substep {

/// C += A B with A rows x inner and B inner x cols.
constexpr std::int64_t product_flops(std::int64_t rows, std::int64_t inner, std::int64_t cols) {
  return 2 * rows * inner * cols;
}

/// L D L^T of a dense k x k block, 1/d kept.
constexpr std::int64_t ldlt_flops(std::int64_t k) {
  std::int64_t flops = 0;
  for (std::int64_t j = 0; j < k; ++j) flops += 3 * j + 1 + (k - 1 - j) * (2 * j + 1);
  return flops;
}

/// x := L^-1 x for `cols` columns, L k x k with ones on its diagonal.
constexpr std::int64_t unit_triangle_flops(std::int64_t k, std::int64_t cols = 1) {
  return k * (k - 1) * cols;
}

}  // namespace substep
