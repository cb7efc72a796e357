#include "core/solver/articulated_joint.hpp"

#include <algorithm>

#include "core/solver/dense_ldlt.hpp"

namespace substep {

// Everything at the pivot, world axes. The child moves with v = v_parent + E y + F q: y are the
// speeds that the joint's rows are about, q those that it leaves free. R is the momentum that the
// joint hands to the child:
//   R = A v - g,   F^T R = 0,   x = E^T R,   y_r = -w_r - s_r x_r,
// E dual to the rows of J, so that R = J^T x. First q (Featherstone's articulated inertia):
//   A1 = A - A F (F^T A F)^-1 F^T A,   g1 = g - A F (F^T A F)^-1 F^T g,
//   R = A1 (v_parent + E y) - g1.
// Then y, with Sigma = E diag(s) E^T:
//   R = P v_parent - g_parent,   P = (1 + A1 Sigma)^-1 A1,   g_parent = g1 + P (E w - Sigma g1).
// P is A1 in series with a spring of compliance Sigma. One row at a time that is
//   A1 -= A1 e (s / (1 + s e.A1 e)) (A1 e)^T,
// nothing for s = 0, and without loss of digits for any s. Backwards come R, x, y, and then
//   q = (F^T A F)^-1 F^T (g - A (v_parent + E y)).

namespace {

void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double dot6(const double* a, const double* b) { return dot(a, b) + dot(a + 3, b + 3); }

// While it is worked on, a Square6 is kept in 2 x 2 blocks on and above the diagonal.

/// A e for an angular direction e.
void angular_column(const Square6& A, const double* e, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = A[i][3] * e[0] + A[i][4] * e[1] + A[i][5] * e[2];
  out[3] = A[3][3] * e[0] + A[3][4] * e[1] + A[3][5] * e[2];
  out[4] = A[3][4] * e[0] + A[4][4] * e[1] + A[4][5] * e[2];
  out[5] = A[3][5] * e[0] + A[4][5] * e[1] + A[5][5] * e[2];
}

/// A -= a factor a^T.
void subtract_outer(const double* __restrict a, double factor, Square6& A) {
  for (int i = 0; i < 6; ++i) {
    const double f = a[i] * factor;
    for (int j = i & ~1; j < 6; ++j) A[i][j] -= f * a[j];
  }
}

/// A symmetric matrix from its upper half.
void mirror(Square6& A) {
  for (int i = 1; i < 6; ++i) {
    for (int j = 0; j < i; ++j) A[i][j] = A[j][i];
  }
}

/// The inertia of a body about a point at r from its centre, Mt given by its inverse.
void add_inertia(const InverseMass& inverse, const double* r, Square6& A) {
  double I[3][3];
  inverse_of(inverse.angular, I);
  const double m = 1.0 / inverse.linear;
  const double mx = m * r[0];
  const double my = m * r[1];
  const double mz = m * r[2];
  for (int i = 0; i < 3; ++i) A[i][i] += m;
  A[0][4] -= mz;
  A[0][5] += my;
  A[1][3] += mz;
  A[1][5] -= mx;
  A[2][3] -= my;
  A[2][4] += mx;
  A[3][3] += I[0][0] + (my * r[1] + mz * r[2]);
  A[4][4] += I[1][1] + (mx * r[0] + mz * r[2]);
  A[5][5] += I[2][2] + (mx * r[0] + my * r[1]);
  A[3][4] += I[1][0] - mx * r[1];
  A[3][5] += I[2][0] - mx * r[2];
  A[4][5] += I[2][1] - my * r[2];
}

}  // namespace

// X^T P X with X = [ E [r]; 0 E ]:  C' = C + L [r],  Omega' = Omega - [r] C' + C^T [r].
void add_shifted(const Square6& P, const double* r, Square6& A) {
  double C[3][3];
  for (int i = 0; i < 3; ++i) {
    const double* L = P[i];
    C[i][0] = L[3] + (L[1] * r[2] - L[2] * r[1]);
    C[i][1] = L[4] + (L[2] * r[0] - L[0] * r[2]);
    C[i][2] = L[5] + (L[0] * r[1] - L[1] * r[0]);
    for (int j = i; j < 3; ++j) A[i][j] += L[j];
    for (int j = 0; j < 3; ++j) A[i][3 + j] += C[i][j];
  }
  const auto omega = [&](int i, int j, double rC) {
    const int k = (j + 1) % 3;
    const int l = (j + 2) % 3;
    A[3 + i][3 + j] += (P[3 + i][3 + j] - rC) + (P[k][3 + i] * r[l] - P[l][3 + i] * r[k]);
  };
  omega(0, 0, r[1] * C[2][0] - r[2] * C[1][0]);
  omega(0, 1, r[1] * C[2][1] - r[2] * C[1][1]);
  omega(0, 2, r[1] * C[2][2] - r[2] * C[1][2]);
  omega(1, 1, r[2] * C[0][1] - r[0] * C[2][1]);
  omega(1, 2, r[2] * C[0][2] - r[0] * C[2][2]);
  omega(2, 2, r[0] * C[1][2] - r[1] * C[0][2]);
}

void ArticulatedJoint::read(const Block& joint, bool child_is_a, std::span<const Vec6> u_star) {
  rows_ = joint.rows;
  sign_ = child_is_a ? 1.0 : -1.0;
  const int parent = child_is_a ? joint.b : joint.a;
  const Vec3& r = child_is_a ? joint.r_a : joint.r_b;
  const Vec3& r_parent = child_is_a ? joint.r_b : joint.r_a;
  for (int i = 0; i < 3; ++i) {
    r_[i] = r[i];
    r_parent_[i] = r_parent[i];
  }
  std::copy(joint.softness, joint.softness + joint.rows, softness_);

  const double* u = u_star[static_cast<std::size_t>(child_is_a ? joint.a : joint.b)].data();
  double speed[6];  // of the child at the pivot, from the parent
  cross(u + 3, r_, speed);
  for (int i = 0; i < 3; ++i) {
    speed[i] += u[i];
    speed[3 + i] = u[3 + i];
  }
  if (parent >= 0) {
    const double* u_parent = u_star[static_cast<std::size_t>(parent)].data();
    double at_pivot[3];
    cross(u_parent + 3, r_parent_, at_pivot);
    for (int i = 0; i < 3; ++i) {
      speed[i] -= u_parent[i] + at_pivot[i];
      speed[3 + i] -= u_parent[3 + i];
    }
  }
  for (int i = 0; i < 3; ++i) w_[i] = speed[i] + sign_ * joint.bias[i];

  if (joint.kind == BlockKind::kBall) {
    n_free_ = 3;
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) free_[k].f[i] = i == k ? 1.0 : 0.0;
    }
    return;
  }
  // The free direction is across both angular rows; e_ is dual to them within their plane.
  n_free_ = 1;
  double J[2][3];
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 3; ++i) {
      J[k][i] = child_is_a ? joint.J_a[3 + k][3 + i] : -joint.J_b[3 + k][3 + i];
    }
    w_[3 + k] = dot(J[k], speed + 3) + sign_ * joint.bias[3 + k];
  }
  double* f = free_[0].f;
  cross(J[0], J[1], f);
  cross(J[1], f, e_[0]);
  cross(f, J[0], e_[1]);
  const double per_square = 1.0 / dot(f, f);
  for (int i = 0; i < 3; ++i) {
    e_[0][i] *= per_square;
    e_[1][i] *= per_square;
  }
}

void ArticulatedJoint::refer_to(const double* reference) {
  for (int i = 0; i < 3; ++i) {
    to_parent_[i] = (reference != nullptr ? reference[i] : 0.0) - r_parent_[i];
    g_[i] = g_[3 + i] = 0.0;
  }
}

void ArticulatedJoint::eliminate(const InverseMass& W, Square6& A, Square6* to_parent) {
  add_inertia(W, r_, A);
  for (int k = 0; k < n_free_; ++k) {
    Free& free = free_[k];
    angular_column(A, free.f, free.column);
    free.inverse = 1.0 / dot(free.f, free.column + 3);
    subtract_outer(free.column, free.inverse, A);
  }
  for (int row = 0; row < rows_; ++row) {
    const double s = softness_[row];
    if (s == 0.0) continue;
    double column[6];
    double along = 0.0;  // e A e
    if (row < 3) {
      for (int j = 0; j < 6; ++j) column[j] = j < row ? A[j][row] : A[row][j];
      along = column[row];
    } else {
      angular_column(A, e_[row - 3], column);
      along = dot(e_[row - 3], column + 3);
    }
    subtract_outer(column, s / (1.0 + s * along), A);
  }
  mirror(A);
  std::copy(A[0], A[0] + 36, P_[0]);
  if (to_parent == nullptr) return;
  std::fill((*to_parent)[0], (*to_parent)[0] + 36, 0.0);
  add_shifted(P_, to_parent_, *to_parent);
  mirror(*to_parent);
}

void ArticulatedJoint::forward(const double* g_centre, double* g_parent) {
  double* g = g_;
  double torque[3];
  cross(r_, g_centre, torque);
  for (int i = 0; i < 3; ++i) {
    g[i] += g_centre[i];
    g[3 + i] += g_centre[3 + i] - torque[i];
  }
  for (int k = 0; k < n_free_; ++k) {
    Free& free = free_[k];
    free.momentum = dot(free.f, g + 3);
    const double q = free.inverse * free.momentum;
    for (int i = 0; i < 6; ++i) g[i] -= free.column[i] * q;
  }
  double d[6] = {};  // E w - Sigma g1
  for (int row = 0; row < 3; ++row) d[row] = w_[row] - softness_[row] * g[row];
  for (int row = 3; row < rows_; ++row) {
    const double* e = e_[row - 3];
    const double y = w_[row] - softness_[row] * dot(e, g + 3);
    for (int i = 0; i < 3; ++i) d[3 + i] += e[i] * y;
  }
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) g[i] += P_[j][i] * d[j];
  }
  if (g_parent == nullptr) return;
  cross(to_parent_, g, torque);
  for (int i = 0; i < 3; ++i) {
    g_parent[i] += g[i];
    g_parent[3 + i] += g[3 + i] - torque[i];
  }
}

void ArticulatedJoint::backward(const double* v_parent, double* v_centre, double* impulse) {
  double* v = v_;
  double R[6];
  for (int i = 0; i < 6; ++i) R[i] = -g_[i];
  if (v_parent != nullptr) {
    cross(to_parent_, v_parent + 3, v);
    for (int i = 0; i < 3; ++i) {
      v[i] += v_parent[i];
      v[3 + i] = v_parent[3 + i];
    }
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 6; ++i) R[i] += P_[j][i] * v[j];
    }
  } else {
    std::fill(v, v + 6, 0.0);
  }
  for (int row = 0; row < 3; ++row) {
    v[row] -= w_[row] + softness_[row] * R[row];
    impulse[row] = sign_ * R[row];
  }
  for (int row = 3; row < rows_; ++row) {
    const double* e = e_[row - 3];
    const double x = dot(e, R + 3);
    const double y = w_[row] + softness_[row] * x;
    for (int i = 0; i < 3; ++i) v[3 + i] -= e[i] * y;
    impulse[row] = sign_ * x;
  }
  for (int k = n_free_; k-- > 0;) {
    const Free& free = free_[k];
    const double q = free.inverse * (free.momentum - dot6(free.column, v));
    for (int i = 0; i < 3; ++i) v[3 + i] += free.f[i] * q;
  }
  cross(r_, v + 3, v_centre);
  for (int i = 0; i < 3; ++i) {
    v_centre[i] += v[i];
    v_centre[3 + i] = v[3 + i];
  }
}

}  // namespace substep
