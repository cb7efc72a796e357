#pragma once
// L D L^T of small dense matrices in row-major order. Innermost loops run along a row, so that
// compilers can take two columns at a time without touching the order of a sum.

#include <cstddef>
#include <limits>

namespace substep {

/// The inverse of a symmetric 3 x 3 matrix by its cofactors. @param out on and below the diagonal
template <class Matrix>
void inverse_of(const Matrix& W, double (&out)[3][3]) {
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

/// y -= f x.
inline void subtract_row(const double* __restrict x, double f, int n, double* __restrict y) {
  for (int j = 0; j < n; ++j) y[j] -= f * x[j];
}

/// A = L D L^T in place: L below the diagonal, 1/D apart. A zero pivot makes what follows no
/// number, which is caught.
/// @param A only on and below the diagonal  @param inverse in: least pivots; out: 1/D
inline void factor_ldlt(double* A, int n, double* inverse) {
  for (int j = 0; j < n; ++j) {
    double d = A[j * n + j];
    if (d < inverse[j]) d = inverse[j];
    inverse[j] = d != 0.0 ? 1.0 / d : std::numeric_limits<double>::quiet_NaN();
    for (int i = j + 1; i < n; ++i) {
      const double l = A[i * n + j] * inverse[j];
      for (int k = j + 1; k <= i; ++k) A[i * n + k] -= l * A[k * n + j];
    }
    for (int i = j + 1; i < n; ++i) A[i * n + j] *= inverse[j];
  }
}

/// X := L^-1 X, X n x width.
inline void solve_lower(const double* L, int n, int width, double* X) {
  for (int i = 1; i < n; ++i) {
    for (int m = 0; m < i; ++m) subtract_row(X + m * width, L[i * n + m], width, X + i * width);
  }
}

/// x := L^-T x.
inline void solve_upper(const double* L, int n, double* x) {
  for (int i = n - 1; i > 0; --i) {
    for (int m = 0; m < i; ++m) x[m] -= L[i * n + m] * x[i];
  }
}

/// U += sum over k of Z_k^T d_k Z_k for K rows Z_k of `width`, in 6 x 6 blocks on and above the
/// diagonal.
template <std::size_t K>
void add_gram(const double* __restrict Z, const double* d, double sign, int width,
              double* __restrict U) {
  const auto stride = static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < stride; ++i) {
    double f[K];
    for (std::size_t k = 0; k < K; ++k) f[k] = sign * (Z[k * stride + i] * d[k]);
    for (std::size_t j = i - i % 6; j < stride; ++j) {
      double sum = U[i * stride + j];
      for (std::size_t k = 0; k < K; ++k) sum += f[k] * Z[k * stride + j];
      U[i * stride + j] = sum;
    }
  }
}

/// The same for any number of rows.
inline void add_gram(const double* Z, int rows, const double* d, double sign, int width,
                     double* U) {
  int k = 0;
  for (; k + 6 <= rows; k += 6) add_gram<6>(Z + k * width, d + k, sign, width, U);
  switch (rows - k) {
    case 1:
      return add_gram<1>(Z + k * width, d + k, sign, width, U);
    case 2:
      return add_gram<2>(Z + k * width, d + k, sign, width, U);
    case 3:
      return add_gram<3>(Z + k * width, d + k, sign, width, U);
    case 4:
      return add_gram<4>(Z + k * width, d + k, sign, width, U);
    case 5:
      return add_gram<5>(Z + k * width, d + k, sign, width, U);
    default:
      return;
  }
}

}  // namespace substep
