#include "core/solver/spring.hpp"

#include <algorithm>

#include "core/solver/dense_ldlt.hpp"
#include "core/solver/system.hpp"

namespace substep {

namespace {

// The first rows of a pin are J = +-[E, -[r]] on the body and -+[E, -[r']] on the other, each with
// a stiffness: the signs of the products do not depend on the side.
// Row i of [r] is zero at i, -r_l at j and r_j at l. Repeated sums stay in registers; factors are
// passed by value, because they might alias M.

struct Three {
  double of[3];
  double operator[](std::size_t i) const { return of[i]; }
};

/// J^T k J of one side, on and below the diagonal. @param M 6 rows of n
void add_pin_square(Three k, Three r, double* M, std::size_t n) {
  double diagonal[3] = {M[3 * n + 3], M[4 * n + 4], M[5 * n + 5]};
  unrolled<0, 3>([&](auto i) {
    constexpr std::size_t j = (i + 1) % 3;
    constexpr std::size_t l = (i + 2) % 3;
    constexpr std::size_t low = std::min(j, l);
    constexpr std::size_t high = std::max(j, l);
    const double kj = k[i] * r[j];
    const double kl = k[i] * r[l];
    M[i * n + i] += k[i];
    M[(3 + j) * n + i] += kl;
    M[(3 + l) * n + i] -= kj;
    diagonal[j] += kl * r[l];
    diagonal[l] += kj * r[j];
    M[(3 + high) * n + 3 + low] -= (k[i] * r[low]) * r[high];
  });
  unrolled<0, 3>([&](auto i) { M[(3 + i) * n + 3 + i] = diagonal[i]; });
}

/// J^T k J' between both sides. @param B 6 rows of n
void add_pin_between(Three k, Three r, Three r_other, double* B, std::size_t n) {
  double diagonal[3] = {B[3 * n + 3], B[4 * n + 4], B[5 * n + 5]};
  unrolled<0, 3>([&](auto i) {
    constexpr std::size_t j = (i + 1) % 3;
    constexpr std::size_t l = (i + 2) % 3;
    const double kj = k[i] * r[j];
    const double kl = k[i] * r[l];
    B[i * n + i] -= k[i];
    B[i * n + 3 + j] -= k[i] * r_other[l];
    B[i * n + 3 + l] += k[i] * r_other[j];
    B[(3 + j) * n + i] -= kl;
    B[(3 + l) * n + i] += kj;
    diagonal[j] -= kl * r_other[l];
    diagonal[l] -= kj * r_other[j];
    B[(3 + j) * n + 3 + l] += kl * r_other[j];
    B[(3 + l) * n + 3 + j] += kj * r_other[l];
  });
  unrolled<0, 3>([&](auto i) { B[(3 + i) * n + 3 + i] = diagonal[i]; });
}

/// A row with J and J_other of the two sides, which are zero before `first`.
template <std::size_t first>
void add_row(double k, const double (&J)[6], const double (&J_other)[6], const SpringTarget& to) {
  for (std::size_t i = first; i < 6; ++i) {
    const double f = k * J[i];
    for (std::size_t j = first; j <= i; ++j) to.A[i][j] += f * J[j];
  }
  if (to.B == nullptr) return;
  for (std::size_t i = first; i < 6; ++i) {
    const double f = k * J[i];
    const double f_other = k * J_other[i];
    for (std::size_t j = first; j < 6; ++j) to.B[i * to.stride + j] += f * J_other[j];
    for (std::size_t j = first; j <= i; ++j) to.U[i * to.stride + j] += f_other * J_other[j];
  }
}

}  // namespace

void add_springs(const Block& block, bool is_a, const SpringTarget& to) {
  if (block.has_point_rows) {
    const auto three = [](const Vec3& r) { return Three{{r[0], r[1], r[2]}}; };
    const Three r = three(is_a ? block.r_a : block.r_b);
    const Three r_other = three(is_a ? block.r_b : block.r_a);
    const Three k{{1.0 / block.softness[0], 1.0 / block.softness[1], 1.0 / block.softness[2]}};
    add_pin_square(k, r, to.A[0], 6);
    if (to.B != nullptr) {
      add_pin_between(k, r, r_other, to.B, to.stride);
      add_pin_square(k, r_other, to.U, to.stride);
    }
    for (int row = 3; row < block.rows; ++row) {
      double opposite[6];  // J_b
      for (int j = 0; j < 6; ++j) opposite[j] = -block.J_a[row][j];
      add_row<3>(1.0 / block.softness[row], block.J_a[row], opposite, to);
    }
    return;
  }
  const auto& J = is_a ? block.J_a : block.J_b;
  const auto& J_other = is_a ? block.J_b : block.J_a;
  for (int row = 0; row < block.rows; ++row) {
    if (block.active_set[row] == 0) add_row<0>(1.0 / block.softness[row], J[row], J_other[row], to);
  }
}

void spring_impulses(const double* w, const Vec6* a, const Vec6* b, Block& block) {
  double speed[kMaxRows];
  row_speeds(block, a, b, speed);
  for (int row = 0; row < block.rows; ++row) {
    if (block.active_set[row] == 0)
      block.impulse[row] = -(w[row] + speed[row]) / block.softness[row];
  }
}

}  // namespace substep
