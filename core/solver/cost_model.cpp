#include "core/solver/cost_model.hpp"

#include "core/constraints/stiffness_matrix.hpp"

namespace substep {
namespace {

constexpr std::int64_t kSkew = 12;                         // [f][r] of two vectors
constexpr std::int64_t kSum = 9;                           // of two 3 x 3 matrices
constexpr std::int64_t kProduct = product_flops(3, 3, 3);  // of two 3 x 3 matrices
constexpr std::int64_t kWide = product_flops(3, 3, 6);     // of a 3 x 3 and a 3 x 6 matrix
constexpr std::int64_t kMotion = 60;                       // a body at another pose

std::int64_t bodies_of(const Block& block) {
  return (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
}

/// Entries by which a row of a block is multiplied: the linear part of point rows is +-E.
std::int64_t entries_of(const Block& block) { return block.has_point_rows ? 3 : 6; }

bool has_angles(const Block& joint) { return joint.rows > joint.position_rows; }

std::int64_t normal_flops(std::int64_t bodies) {
  const std::int64_t normal = 2 * kProduct + kSum;                   // N_b, H r
  const std::int64_t torques = 4 * kWide + 2 * kProduct + 5 * kSum;  // by each body
  return normal + torques + bodies * bodies * 2 * 36;                // scaled, added
}

std::int64_t friction_flops(std::int64_t bodies) {
  const std::int64_t force =
      2 * kProduct + kSum + 9 + 2 * (36 + 18) + 27;               // g, dn, dg by each body
  const std::int64_t arms = 2 * 18 + 3 * kSum;                    // dr by each
  return force + arms + bodies * bodies * (2 * kWide + 18 + 36);  // torques, added
}

// [f][r] of each body, and, if rows are angles, the products of their axes with these pairs.
std::int64_t joint_stiffness_flops(const Block& joint, std::int64_t pairs) {
  return bodies_of(joint) * (kSkew + kSum) + (has_angles(joint) ? 9 + kSkew + pairs * kSum : 0);
}

std::int64_t stiffness_flops(const Block& block, ContactTerms terms) {
  const std::int64_t bodies = bodies_of(block);
  if (!block.is_contact()) return joint_stiffness_flops(block, bodies * bodies);
  if (terms == ContactTerms::kPaper) {
    return 3 + (block.rows == 3 ? 12 : 0) + bodies * (kSkew + kSum);
  }
  if (block.lambda[0] == 0.0) return 0;
  const bool friction = terms == ContactTerms::kExact && block.rows == 3;
  return normal_flops(bodies) + (friction ? friction_flops(bodies) : 0);
}

// Only the derivative of a body's torque by its own rotation.
std::int64_t turning_stiffness_flops(const Block& block) {
  if (!block.is_contact()) return joint_stiffness_flops(block, bodies_of(block));
  if (block.lambda[0] == 0.0) return 0;
  // H r, its torque and that of n; H rho and n, their torque
  return (block.a >= 0 ? 3 * kProduct + 3 * kSum : 0) +
         (block.b >= 0 ? 2 * kProduct + 3 * kSum : 0);
}

}  // namespace

FactorFlops node_flops(std::int64_t rows, std::int64_t width, bool leaf,
                       const FactorFlops& springs) {
  // Zero blocks of a leaf are counted as dense.
  const std::int64_t gram = width * (width + 6);  // per pivot: two operations on half a square
  const std::int64_t body = ldlt_flops(6) + unit_triangle_flops(6, width + rows) + 6 * gram +
                            product_flops(rows, 6, width) + springs.factor;
  return {(leaf ? 0 : body) + product_flops(rows, 6, rows + 6) / 2 + ldlt_flops(rows) +
              unit_triangle_flops(rows, width) + rows * gram,
          springs.solve + 2 * (unit_triangle_flops(6) + unit_triangle_flops(rows) +
                               product_flops(rows, 6, 2) + product_flops(rows + 6, width, 1))};
}

std::int64_t update_flops(std::int64_t width) { return width * (width + 6) / 2; }

FactorFlops articulated_flops(std::int64_t rows, bool exact) {
  return {250 + (rows == 3 ? 240 : 84) + (exact ? 0 : 82 * rows),
          150 + (rows == 3 ? 105 : 35) + (exact ? 0 : 72 + 16 * rows)};
}

FactorFlops spring_flops(const Block& block, std::int64_t rows, std::int64_t bodies) {
  const std::int64_t other = bodies - 1;
  const auto of_row = [&](std::int64_t n) {  // n gradients of each body
    return FactorFlops{1 + n + n * (n + 1) + other * (2 * n + 4 * n * n), 3 + bodies * 4 * n};
  };
  const FactorFlops of_point{13 + other * 28, 3 + bodies * 13};
  const std::int64_t points = block.has_point_rows ? 3 : 0;
  const FactorFlops further = of_row(entries_of(block));
  return {points * of_point.factor + (rows - points) * further.factor,
          points * of_point.solve + (rows - points) * further.solve};
}

std::int64_t residual_flops(const Block& block) {
  return 2 * product_flops(block.rows, 6, bodies_of(block)) + 5 * block.rows;
}

// J, Mt^-1 J^T and the products of the rows on each body.
std::int64_t pack_flops(const Block& block) {
  const std::int64_t n = block.rows;
  const std::int64_t side =
      18 * n + n * (n + 1) * entries_of(block) + (block.has_point_rows ? 3 : 0);
  return bodies_of(block) * side + 2 * n;
}

// J u and Mt^-1 J^T change on each body, the coupling of the rows, and per row softness, step and
// bounds.
std::int64_t visit_flops(const Block& block) {
  const std::int64_t n = block.rows;
  const std::int64_t side =
      2 * product_flops(n, entries_of(block), 1) + (block.has_point_rows ? 9 : 0);
  return bodies_of(block) * side + unit_triangle_flops(n) + 5 * n;
}

// Rows at the current poses, the direction, and on each body the gradient, its response and the
// impulse.
std::int64_t correction_flops(const Block& block, std::int64_t rows) {
  constexpr std::int64_t kPush = 50;
  return move_flops(block, rows) + rows * 6 + 6 +
         bodies_of(block) * (product_flops(6, rows, 1) + product_flops(3, 3, 1) + 15 + kPush);
}

std::int64_t move_flops(const Block& block, std::int64_t rows) {
  constexpr std::int64_t kRow = 15;  // phi and J of one row
  return kRow * rows + kMotion * bodies_of(block);
}

// Rows at other poses, their averages, and the Hessian.
std::int64_t relinearise_flops(std::span<const Block> blocks, std::int64_t bodies, Forces forces) {
  constexpr std::int64_t kBody = 2 * kProduct + 30 +               // D
                                 2 * kProduct + 40 +               // Mt^-1
                                 2 * product_flops(3, 3, 1) + 30;  // u, its change
  constexpr std::int64_t kCourse = 2 * 400;  // two rotations of three iterations each
  std::int64_t flops = kBody * bodies;
  for (const Block& block : blocks) {
    const std::int64_t sides = bodies_of(block);
    flops += move_flops(block, block.rows) + product_flops(block.rows, 6, sides) + 4 * block.rows +
             turning_stiffness_flops(block);
    if (forces == Forces::kEnd) continue;
    flops += 4 * (block.rows * entries_of(block) + 3) * sides;
    if (forces != Forces::kNumerov) continue;
    flops += move_flops(block, block.rows) + (20 + 3 * 12) * block.rows * sides;
  }
  return flops + (forces == Forces::kNumerov ? kCourse * bodies : 0);
}

std::int64_t aim_flops(std::span<const Block> blocks, std::int64_t bodies) {
  constexpr std::int64_t kBody = 2 * 50 + kMotion;  // w, w^
  std::int64_t flops = kBody * bodies;
  for (const Block& block : blocks) {
    if (block.is_bounded()) continue;
    flops += (15 + 4) * block.rows + product_flops(block.rows, 6, bodies_of(block));
  }
  return flops;
}

std::int64_t criterion_flops(std::span<const Block> blocks, ContactTerms terms,
                             const StiffnessMatrix& K) {
  // Columns are rotated, squared and summed; one root per column.
  const std::int64_t size = K.block_size();
  std::int64_t flops = static_cast<std::int64_t>(K.blocks()) * size * size * (5 + 2) +
                       size * static_cast<std::int64_t>(K.bodies());
  for (const Block& block : blocks) flops += stiffness_flops(block, terms);
  return flops;
}

}  // namespace substep
