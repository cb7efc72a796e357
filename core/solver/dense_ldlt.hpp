#pragma once
// L D L^T of small dense matrices in row-major order. Innermost loops run along a row, so that
// compilers can vectorise over columns without reordering sums.

#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/math/pair.hpp"

namespace substep {

/// The inverse of a symmetric 3 x 3 matrix by its cofactors. @param out on and below the diagonal
template <class Matrix>
[[gnu::always_inline]] inline void inverse_of(const Matrix& W, double (&out)[3][3]) {
  out[0][0] = W(1, 1) * W(2, 2) - W(2, 1) * W(2, 1);
  out[1][0] = W(2, 1) * W(2, 0) - W(1, 0) * W(2, 2);
  out[2][0] = W(1, 0) * W(2, 1) - W(1, 1) * W(2, 0);
  out[1][1] = W(0, 0) * W(2, 2) - W(2, 0) * W(2, 0);
  out[2][1] = W(1, 0) * W(2, 0) - W(0, 0) * W(2, 1);
  out[2][2] = W(0, 0) * W(1, 1) - W(1, 0) * W(1, 0);
  const double determinant = W(0, 0) * out[0][0] + W(1, 0) * out[1][0] + W(2, 0) * out[2][0];
  const double per_determinant = 1.0 / determinant;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) out[i][j] *= per_determinant;
  }
}

/// A compile-time size: kernels with one are unrolled. Run-time sizes are ints.
template <int N>
using Known = std::integral_constant<int, N>;

/// Unrolled loop: calls with each of first .. last - 1 as a Known.
template <int first, int last>
[[gnu::always_inline]] inline void unrolled(const auto& call) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (call(Known<first + i>{}), ...); }
  (std::make_integer_sequence<int, (last > first ? last - first : 0)>{});
}

/// Calls with the number of rows, as a compile-time size if it is 1 or 2.
void with_known(int rows, const auto& call) {
  switch (rows) {
    case 1:
      return call(Known<1>{});
    case 2:
      return call(Known<2>{});
    default:
      return call(rows);
  }
}

/// y -= f x.
inline void subtract_row(const double* __restrict x, double f, auto n, double* __restrict y) {
  for (int j = 0; j < n; ++j) y[j] -= f * x[j];
}

/// 1/D of a pivot. A zero pivot yields NaN, which is detected later.
inline double inverse_of_pivot(double d, double least) {
  if (d < least) d = least;
  return d != 0.0 ? 1.0 / d : std::numeric_limits<double>::quiet_NaN();
}

/// A = L D L^T in place: L below the diagonal, 1/D apart.
/// @param A only on and below the diagonal  @param inverse in: least pivots; out: 1/D
/// @return true if a pivot was raised to its minimum
inline bool factor_ldlt(double* A, int n, double* inverse) {
  bool held = false;
  for (int j = 0; j < n; ++j) {
    held |= A[j * n + j] < inverse[j];
    inverse[j] = inverse_of_pivot(A[j * n + j], inverse[j]);
    for (int i = j + 1; i < n; ++i) {
      const double l = A[i * n + j] * inverse[j];
      for (int k = j + 1; k <= i; ++k) A[i * n + k] -= l * A[k * n + j];
    }
    for (int i = j + 1; i < n; ++i) A[i * n + j] *= inverse[j];
  }
  return held;
}

/// The same in registers, with the same order of operations.
template <int N>
bool factor_ldlt(double* A, Known<N> /*n*/, double* inverse) {
  bool held = false;
  constexpr auto size = static_cast<std::size_t>(N);
  double a[size][size];
  unrolled<0, N>([&](auto i) { unrolled<0, i + 1>([&](auto k) { a[i][k] = A[i * N + k]; }); });
  unrolled<0, N>([&](auto j) {
    held |= a[j][j] < inverse[j];
    const double per_d = inverse_of_pivot(a[j][j], inverse[j]);
    inverse[j] = per_d;
    unrolled<j + 1, N>([&](auto i) {
      const double l = a[i][j] * per_d;
      unrolled<j + 1, i + 1>([&](auto k) { a[i][k] -= l * a[k][j]; });
    });
    unrolled<j + 1, N>([&](auto i) { A[i * N + j] = a[i][j] *= per_d; });
  });
  return held;
}

/// X := L^-1 X, X n x width.
inline void solve_lower(const double* L, auto n, auto width, double* X) {
  for (int i = 1; i < n; ++i) {
    for (int m = 0; m < i; ++m) subtract_row(X + m * width, L[i * n + m], width, X + i * width);
  }
}
/// The same, six columns in registers, for widths that are multiples of 6.
template <int N, int Width>
requires(Width % 6 == 0) void solve_lower(const double* L, Known<N> /*n*/, Known<Width> /*width*/,
                                          double* X) {
  for (double* columns = X; columns != X + Width; columns += 6) {
    unrolled<1, N>([&](auto i) {
      Pair row[3];
      unrolled<0, 3>([&](auto p) { row[p] = load_pair(columns + i * Width + 2 * p); });
      unrolled<0, i>([&](auto m) {
        const double l = L[i * N + m];
        unrolled<0, 3>([&](auto p) { row[p] -= l * load_pair(columns + m * Width + 2 * p); });
      });
      unrolled<0, 3>([&](auto p) { store_pair(row[p], columns + i * Width + 2 * p); });
    });
  }
}

/// The same of one column.
template <int N>
void solve_lower(const double* L, Known<N> /*n*/, Known<1> /*width*/, double* x) {
  unrolled<1, N>([&](auto i) {
    double sum = x[i];
    unrolled<0, i>([&](auto m) { sum -= L[i * N + m] * x[m]; });
    x[i] = sum;
  });
}

/// x := L^-T x.
inline void solve_upper(const double* L, auto n, double* x) {
  for (int i = n - 1; i > 0; --i) {
    for (int m = 0; m < i; ++m) x[m] -= L[i * n + m] * x[i];
  }
}

/// Two rows of a 6 x 6 block of sign * sum over k of Z_k^T d_k Z_k, with Z_k rows of `width`; the
/// first `pairs` pairs of their elements.
template <std::size_t pairs>
[[gnu::always_inline]] inline void add_gram_rows(const double* Z_i, const double* Z_j,
                                                 const double* d, auto rows, double sign,
                                                 auto width, double* to, auto stride) {
  Pair first[pairs] = {};
  Pair second[pairs] = {};
  for (int k = 0; k < rows; ++k) {
    const double f = sign * (Z_i[k * width] * d[k]);
    const double g = sign * (Z_i[k * width + 1] * d[k]);
    for (std::size_t p = 0; p < pairs; ++p) {
      const Pair z = load_pair(Z_j + k * width + 2 * p);
      first[p] += f * z;
      second[p] += g * z;
    }
  }
  for (std::size_t p = 0; p < pairs; ++p) {
    store_pair(load_pair(to + 2 * p) + first[p], to + 2 * p);
    store_pair(load_pair(to + stride + 2 * p) + second[p], to + stride + 2 * p);
  }
}

/// One 6 x 6 block. A diagonal block is symmetric; only its lower half is complete.
/// @param Z_i, Z_j the columns of the block in the first row  @param to the block, added to
template <bool on_diagonal>
void add_gram_block(const double* Z_i, const double* Z_j, const double* d, auto rows, double sign,
                    auto width, double* to, auto stride) {
  add_gram_rows<on_diagonal ? 1 : 3>(Z_i, Z_j, d, rows, sign, width, to, stride);
  add_gram_rows<on_diagonal ? 2 : 3>(Z_i + 2, Z_j, d, rows, sign, width, to + 2 * stride, stride);
  add_gram_rows<3>(Z_i + 4, Z_j, d, rows, sign, width, to + 4 * stride, stride);
}

/// All blocks of the sum on and above the diagonal. @param U width x width, accumulated
template <int K, int Width>
void add_gram(const double* Z, const double* d, Known<K> rows, double sign, Known<Width> width,
              double* U) {
  for (int s = 0; s < width; s += 6) {
    double* row = U + s * width;
    add_gram_block<true>(Z + s, Z + s, d, rows, sign, width, row + s, width);
    for (int t = s + 6; t < width; t += 6) {
      add_gram_block<false>(Z + s, Z + t, d, rows, sign, width, row + t, width);
    }
  }
}

/// The same for wide rows: the innermost loop runs along the whole row.
template <int K>
void add_gram(const double* __restrict Z, const double* d, Known<K> /*rows*/, double sign,
              int width, double* __restrict U) {
  for (int i = 0; i < width; ++i) {
    double f[static_cast<std::size_t>(K)];
    for (int k = 0; k < K; ++k) f[k] = sign * (Z[k * width + i] * d[k]);
    for (int j = i - i % 6; j < width; ++j) {
      double sum = U[i * width + j];
      for (int k = 0; k < K; ++k) sum += f[k] * Z[k * width + j];
      U[i * width + j] = sum;
    }
  }
}

/// The same for any number of rows.
inline void add_gram(const double* Z, const double* d, int rows, double sign, auto width,
                     double* U) {
  int k = 0;
  for (; k + 6 <= rows; k += 6) add_gram(Z + k * width, d + k, Known<6>{}, sign, width, U);
  unrolled<1, 6>([&](auto left) {
    if (rows - k == left) add_gram(Z + k * width, d + k, left, sign, width, U);
  });
}

}  // namespace substep
