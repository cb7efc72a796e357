#pragma once
// A symmetric 6 x 6 matrix in registers, two doubles at a time. Avoids round trips through memory
// between scalar and vector operations, which would stall.

#include "core/math/pair.hpp"

namespace substep {

/// A symmetric 6 x 6 matrix of a body in memory, linear part first.
using Square6 = double[6][6];

/// A vector of a body: linear part first.
struct Pairs6 {
  Pair p[3];
  double operator[](int i) const { return p[i / 2][i % 2]; }
};

inline Pairs6 combine(double f, const Pairs6& a) { return {{f * a.p[0], f * a.p[1], f * a.p[2]}}; }
inline Pairs6 combine(double f, const Pairs6& a, double g, const Pairs6& b) {
  return {{f * a.p[0] + g * b.p[0], f * a.p[1] + g * b.p[1], f * a.p[2] + g * b.p[2]}};
}
inline Pairs6 combine(double f, const Pairs6& a, double g, const Pairs6& b, double h,
                      const Pairs6& c) {
  return {{f * a.p[0] + g * b.p[0] + h * c.p[0], f * a.p[1] + g * b.p[1] + h * c.p[1],
           f * a.p[2] + g * b.p[2] + h * c.p[2]}};
}

/// All 6 x 6 elements, for products with vectors.
struct Rows6 {
  Pairs6 row[6];
  double operator()(int i, int j) const { return row[i][j]; }

  /// A x for a symmetric A.
  [[nodiscard]] Pairs6 times(const double (&x)[6]) const {
    Pairs6 sum;
    for (int p = 0; p < 3; ++p) {
      sum.p[p] = (row[0].p[p] * x[0] + row[1].p[p] * x[1] + row[2].p[p] * x[2]) +
                 (row[3].p[p] * x[3] + row[4].p[p] * x[4] + row[5].p[p] * x[5]);
    }
    return sum;
  }
};

/// 2 x 2 blocks on and above the diagonal.
class Symmetric6 {
 public:
  /// Element of the upper half.
  double operator()(int i, int j) const { return row_[i].p[j / 2][j % 2]; }

  void set(int i, const Pair& p0, const Pair& p1, const Pair& p2) { row_[i] = {{p0, p1, p2}}; }

  /// A e for a direction of rotation e.
  [[nodiscard, gnu::always_inline]] Pairs6 angular_column(const double (&e)[3]) const {
    const Symmetric6& A = *this;
    const auto linear = [&](int i) { return A(i, 3) * e[0] + A(i, 4) * e[1] + A(i, 5) * e[2]; };
    const double x = A(3, 3) * e[0] + A(3, 4) * e[1] + A(3, 5) * e[2];
    const double y = A(3, 4) * e[0] + A(4, 4) * e[1] + A(4, 5) * e[2];
    const double z = A(3, 5) * e[0] + A(4, 5) * e[1] + A(5, 5) * e[2];
    return {{Pair{linear(0), linear(1)}, Pair{linear(2), x}, Pair{y, z}}};
  }

  /// A -= a b^T, which must be symmetric.
  void subtract(const Pairs6& a, const Pairs6& b) {
    for (int i = 0; i < 6; ++i) {
      for (int p = i / 2; p < 3; ++p) row_[i].p[p] -= a[i] * b.p[p];
    }
  }

  /// A -= a b^T + c d^T; the sum must be symmetric.
  void subtract(const Pairs6& a, const Pairs6& b, const Pairs6& c, const Pairs6& d) {
    for (int i = 0; i < 6; ++i) {
      for (int p = i / 2; p < 3; ++p) row_[i].p[p] -= a[i] * b.p[p] + c[i] * d.p[p];
    }
  }

  // In series with a spring of compliance D = diag(s) in the linear directions. With L, C, Omega
  // the blocks of A and G = (1 + L D)^-1:
  //   L' = G L,   C' = G C,   Omega' = Omega - C^T D C',
  // without cancellation for any s. G is computed from its cofactors.
  void soften_linear(const double* s) {
    const Symmetric6& A = *this;
    const double n00 = 1.0 + A(0, 0) * s[0], n01 = A(0, 1) * s[1], n02 = A(0, 2) * s[2];
    const double n10 = A(0, 1) * s[0], n11 = 1.0 + A(1, 1) * s[1], n12 = A(1, 2) * s[2];
    const double n20 = A(0, 2) * s[0], n21 = A(1, 2) * s[1], n22 = 1.0 + A(2, 2) * s[2];
    const double c00 = n11 * n22 - n12 * n21;
    const double c10 = n12 * n20 - n10 * n22;
    const double c20 = n10 * n21 - n11 * n20;
    const double g = 1.0 / (n00 * c00 + n01 * c10 + n02 * c20);
    const Pairs6 a0 = row_[0];
    const Pairs6 a1 = row_[1];
    const Pairs6 a2{{Pair{A(0, 2), A(1, 2)}, row_[2].p[1], row_[2].p[2]}};
    row_[0] =
        combine(g * c00, a0, g * (n02 * n21 - n01 * n22), a1, g * (n01 * n12 - n02 * n11), a2);
    row_[1] =
        combine(g * c10, a0, g * (n00 * n22 - n02 * n20), a1, g * (n02 * n10 - n00 * n12), a2);
    row_[2] =
        combine(g * c20, a0, g * (n01 * n20 - n00 * n21), a1, g * (n00 * n11 - n01 * n10), a2);
    for (int i = 3; i < 6; ++i) {
      const double f0 = a0[i] * s[0];
      const double f1 = a1[i] * s[1];
      const double f2 = a2[i] * s[2];
      for (int p = i / 2; p < 3; ++p) {
        row_[i].p[p] -= f0 * row_[0].p[p] + f1 * row_[1].p[p] + f2 * row_[2].p[p];
      }
    }
  }

  void rows(Rows6& out) const {
    for (int p = 0; p < 3; ++p) {  // column order: in row order compilers emit calls to memcpy
      for (int i = 0; i < 2 * p + 2; ++i) out.row[i].p[p] = row_[i].p[p];
      for (int q = p + 1; q < 3; ++q) {
        const Pair& upper = row_[2 * p].p[q];
        const Pair& lower = row_[2 * p + 1].p[q];
        out.row[2 * q].p[p] = Pair{upper[0], lower[0]};
        out.row[2 * q + 1].p[p] = Pair{upper[1], lower[1]};
      }
    }
  }

 private:
  Pairs6 row_[6];
};

// The inertia about a point moved by r: X^T A X with X = [ E [r]; 0 E ],
//   C' = C + L [r],  Omega' = Omega - [r] C' + C^T [r].
/// @param A its upper half is read  @param out its upper half
inline void shift(const auto& A, const double* r, Square6& out) {
  const double L[3][3] = {
      {A(0, 0), A(0, 1), A(0, 2)}, {A(0, 1), A(1, 1), A(1, 2)}, {A(0, 2), A(1, 2), A(2, 2)}};
  double C[3][3];
  for (int i = 0; i < 3; ++i) {
    C[i][0] = A(i, 3) + (L[i][1] * r[2] - L[i][2] * r[1]);
    C[i][1] = A(i, 4) + (L[i][2] * r[0] - L[i][0] * r[2]);
    C[i][2] = A(i, 5) + (L[i][0] * r[1] - L[i][1] * r[0]);
    for (int j = 0; j < 3; ++j) {
      out[i][j] = L[i][j];
      out[i][3 + j] = C[i][j];
    }
  }
  const auto omega = [&](int i, int j, double rC) {
    const int k = (j + 1) % 3;
    const int l = (j + 2) % 3;
    out[3 + i][3 + j] = (A(3 + i, 3 + j) - rC) + (A(k, 3 + i) * r[l] - A(l, 3 + i) * r[k]);
  };
  omega(0, 0, r[1] * C[2][0] - r[2] * C[1][0]);
  omega(0, 1, r[1] * C[2][1] - r[2] * C[1][1]);
  omega(0, 2, r[1] * C[2][2] - r[2] * C[1][2]);
  omega(1, 1, r[2] * C[0][1] - r[0] * C[2][1]);
  omega(1, 2, r[2] * C[0][2] - r[0] * C[2][2]);
  omega(2, 2, r[0] * C[1][2] - r[1] * C[0][2]);
}

}  // namespace substep
