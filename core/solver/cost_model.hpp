#pragma once
// The cost model: floating-point operations of all kernels. Additions, multiplications, divisions
// and roots count one each. The counts depend only on numbers of rows, bodies, pivots, corrections
// and contacts that carry force, so they are the same on every machine. A new joint or solver uses
// the formulas that are here; joints need none of their own.

#include <cstdint>
#include <span>

#include "core/constraints/block.hpp"
#include "core/constraints/contact.hpp"
#include "core/model/settings.hpp"

namespace substep {

class StiffnessMatrix;

// Dense matrices.

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

// Elimination of the saddle system.

/// Operations of adding something to a factor, and of one solve with it.
struct FactorFlops {
  std::int64_t factor = 0;
  std::int64_t solve = 0;
};
/// A node of the elimination: a body with its free rows. Its pivots are the rows, and the six
/// velocities of the body unless it is a leaf, whose mass is diagonal.
/// @param width number of unknowns of later bodies that it is coupled to
/// @param leaf only rows are eliminated  @param springs of the rows that are folded into the mass
FactorFlops node_flops(std::int64_t rows, std::int64_t width, bool leaf,
                       const FactorFlops& springs);
/// Adding the contribution of a node of this width to a later one.
std::int64_t update_flops(std::int64_t width);
/// A joint eliminated like a link of an articulated body. @param exact no row has softness
FactorFlops articulated_flops(std::int64_t rows, bool exact);
/// Rows folded into the masses as springs. @param rows the free ones  @param bodies moving, 1 or 2
FactorFlops spring_flops(const Block& block, std::int64_t rows, std::int64_t bodies);
/// The residual of a block's rows and its right-hand side, in one refinement.
std::int64_t residual_flops(const Block& block);

// Sweeps over blocks.

/// PGS: packing a block, and one visit.
std::int64_t pack_flops(const Block& block);
std::int64_t visit_flops(const Block& block);
/// XPBD: one correction along `rows` rows of a block.
std::int64_t correction_flops(const Block& block, std::int64_t rows);
/// Rows of a block at other poses: phi and J.
std::int64_t move_flops(const Block& block, std::int64_t rows);

// Newton and Störmer.

/// A Newton step without its linear solve.
std::int64_t relinearise_flops(std::span<const Block> blocks, std::int64_t bodies, Forces forces);
/// Rows about extrapolated poses.
std::int64_t aim_flops(std::span<const Block> blocks, std::int64_t bodies);

// The criterion of stability.

/// Evaluating K of these blocks and the norms of its columns.
std::int64_t criterion_flops(std::span<const Block> blocks, ContactTerms terms,
                             const StiffnessMatrix& K);

}  // namespace substep
