#include "core/solver/spring.hpp"

#include <algorithm>

#include "core/solver/system.hpp"

namespace substep {

namespace {

// Rows i of E and of [r], which is zero at i, -r_l at j and r_j at l. With J = +-[E, -[r]] on the
// body and -+[E, -[r']] on the other, the products of both sides have signs that do not depend on
// which is which.
template <int i>
void add_pin(double k, const double* r, const double* r_other, const SpringTarget& to) {
  constexpr std::size_t j = (i + 1) % 3;
  constexpr std::size_t l = (i + 2) % 3;
  constexpr std::size_t low = std::min(j, l);
  constexpr std::size_t high = std::max(j, l);
  const double kj = k * r[j];
  const double kl = k * r[l];
  to.A[i][i] += k;
  to.A[3 + j][i] += kl;
  to.A[3 + l][i] -= kj;
  to.A[3 + j][3 + j] += kl * r[l];
  to.A[3 + l][3 + l] += kj * r[j];
  to.A[3 + high][3 + low] -= (k * r[low]) * r[high];
  if (to.B == nullptr) return;
  const std::size_t n = to.stride;
  const double qj = k * r_other[j];
  const double ql = k * r_other[l];
  double* B = to.B;
  B[i * n + i] -= k;
  B[i * n + 3 + j] -= ql;
  B[i * n + 3 + l] += qj;
  B[(3 + j) * n + i] -= kl;
  B[(3 + l) * n + i] += kj;
  B[(3 + j) * n + 3 + j] -= kl * r_other[l];
  B[(3 + j) * n + 3 + l] += kl * r_other[j];
  B[(3 + l) * n + 3 + j] += kj * r_other[l];
  B[(3 + l) * n + 3 + l] -= kj * r_other[j];
  double* U = to.U;
  U[i * n + i] += k;
  U[i * n + 3 + j] += ql;
  U[i * n + 3 + l] -= qj;
  U[(3 + j) * n + i] += ql;
  U[(3 + l) * n + i] -= qj;
  U[(3 + j) * n + 3 + j] += ql * r_other[l];
  U[(3 + j) * n + 3 + l] -= ql * r_other[j];
  U[(3 + l) * n + 3 + j] -= qj * r_other[l];
  U[(3 + l) * n + 3 + l] += qj * r_other[j];
}

/// A further row of a pin, with J of either side: the other's is the opposite.
void add_turn(double k, const double (&J)[6], const SpringTarget& to) {
  for (std::size_t i = 3; i < 6; ++i) {
    const double f = k * J[i];
    for (std::size_t j = 3; j <= i; ++j) to.A[i][j] += f * J[j];
  }
  if (to.B == nullptr) return;
  for (std::size_t i = 3; i < 6; ++i) {
    const double f = k * J[i];
    for (std::size_t j = 3; j < 6; ++j) {
      to.B[i * to.stride + j] -= f * J[j];
      to.U[i * to.stride + j] += f * J[j];
    }
  }
}

/// Any row.
void add_row(double k, const double (&J)[6], const double (&J_other)[6], const SpringTarget& to) {
  for (std::size_t i = 0; i < 6; ++i) {
    const double f = k * J[i];
    for (std::size_t j = 0; j <= i; ++j) to.A[i][j] += f * J[j];
  }
  if (to.B == nullptr) return;
  for (std::size_t i = 0; i < 6; ++i) {
    const double f = k * J[i];
    const double f_other = k * J_other[i];
    for (std::size_t j = 0; j < 6; ++j) {
      to.B[i * to.stride + j] += f * J_other[j];
      to.U[i * to.stride + j] += f_other * J_other[j];
    }
  }
}

}  // namespace

void add_springs(const Block& block, bool is_a, const SpringTarget& to) {
  if (block.pinned) {
    const double* r = (is_a ? block.r_a : block.r_b).data();
    const double* r_other = (is_a ? block.r_b : block.r_a).data();
    add_pin<0>(1.0 / block.softness[0], r, r_other, to);
    add_pin<1>(1.0 / block.softness[1], r, r_other, to);
    add_pin<2>(1.0 / block.softness[2], r, r_other, to);
    for (int row = 3; row < block.rows; ++row) {
      add_turn(1.0 / block.softness[row], block.J_a[row], to);
    }
    return;
  }
  const auto& J = is_a ? block.J_a : block.J_b;
  const auto& J_other = is_a ? block.J_b : block.J_a;
  for (int row = 0; row < block.rows; ++row) {
    if (block.tight[row] == 0) add_row(1.0 / block.softness[row], J[row], J_other[row], to);
  }
}

// As add_pin(), add_turn() and add_row() add, push() and row_speeds() multiply.
SpringFlops spring_flops(const Block& block, int rows, int bodies) {
  const std::int64_t other = bodies - 1;
  const auto of_row = [&](std::int64_t n) {  // n gradients of each body
    return SpringFlops{1 + n + n * (n + 1) + other * (2 * n + 4 * n * n), 3 + bodies * 4 * n};
  };
  const SpringFlops of_pin{13 + other * 28, 3 + bodies * 13};
  const std::int64_t pins = block.pinned ? 3 : 0;
  const SpringFlops further = of_row(block.pinned ? 3 : 6);
  return {pins * of_pin.factor + (rows - pins) * further.factor,
          pins * of_pin.solve + (rows - pins) * further.solve};
}

void spring_impulses(const double* w, const Vec6* a, const Vec6* b, Block& block) {
  double speed[kMaxRows];
  row_speeds(block, a, b, speed);
  for (int row = 0; row < block.rows; ++row) {
    if (block.tight[row] == 0) block.impulse[row] = -(w[row] + speed[row]) / block.softness[row];
  }
}

}  // namespace substep
