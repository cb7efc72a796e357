#include "core/solver/articulated_joint.hpp"

#include "core/solver/dense_ldlt.hpp"

namespace substep {

// Everything at the pivot, world axes. The child moves with v = v_parent + E y + F q: y are the
// relative speeds constrained by the joint's rows, q the free ones. R is the momentum transferred
// by the joint to the child:
//   R = A v - g,   F^T R = 0,   x = E^T R,   y_r = -w_r - s_r x_r,
// E dual to the rows of J, so that R = J^T x. First q (Featherstone's articulated inertia):
//   A1 = A - A F (F^T A F)^-1 F^T A,   g1 = g - A F (F^T A F)^-1 F^T g,
//   R = A1 (v_parent + E y) - g1.
// Then y, with Sigma = E diag(s) E^T:
//   R = P v_parent - g_parent,   P = (1 + A1 Sigma)^-1 A1,   g_parent = g1 + P (E w - Sigma g1).
// P is A1 in series with a spring of compliance Sigma; the linear rows and the two angular ones are
// softened in sequence. Back substitution gives R, x, y, and then
//   q = (F^T A F)^-1 F^T (g - A (v_parent + E y)).

namespace {

void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// f A f of a direction of rotation, from A f.
double along(const double (&f)[3], const Pairs6& column) {
  return f[0] * column[3] + f[1] * column[4] + f[2] * column[5];
}

/// Carried inertia plus a body's own, about a point at r from its centre, with Mt given by its
/// inverse.
[[gnu::always_inline]] inline Symmetric6 add_inertia(const InverseMass& inverse, const double* r,
                                                     const Square6& A) {
  double I[3][3];
  inverse_of(inverse.angular, I);
  const double m = 1.0 / inverse.linear;
  const double mx = m * r[0];
  const double my = m * r[1];
  const double mz = m * r[2];
  const Pair none{0.0, 0.0};
  Symmetric6 sum;
  sum.set(0, Pair{A[0][0] + m, A[0][1]}, Pair{A[0][2], A[0][3]}, Pair{A[0][4] - mz, A[0][5] + my});
  sum.set(1, Pair{A[0][1], A[1][1] + m}, Pair{A[1][2], A[1][3] + mz}, Pair{A[1][4], A[1][5] - mx});
  sum.set(2, none, Pair{A[2][2] + m, A[2][3] - my}, Pair{A[2][4] + mx, A[2][5]});
  const double xx = A[3][3] + (I[0][0] + (my * r[1] + mz * r[2]));
  const double yy = A[4][4] + (I[1][1] + (mx * r[0] + mz * r[2]));
  const double zz = A[5][5] + (I[2][2] + (mx * r[0] + my * r[1]));
  const double xy = A[3][4] + (I[1][0] - mx * r[1]);
  const double xz = A[3][5] + (I[2][0] - mx * r[2]);
  const double yz = A[4][5] + (I[2][1] - my * r[2]);
  sum.set(3, none, Pair{A[2][3] - my, xx}, Pair{xy, xz});
  sum.set(4, none, none, Pair{yy, yz});
  sum.set(5, none, none, Pair{yz, zz});
  return sum;
}

/// The two angular rows of a hinge on the child minus the parent: on b they are the negatives of
/// those on a.
struct AngularRows {
  explicit AngularRows(const Block& joint) {
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < 3; ++i) J[k][i] = joint.J_a[3 + k][3 + i];
    }
    cross(J[0], J[1], f);
    per_square = 1.0 / dot(f, f);
  }
  // E = [J_1 x f, f x J_0]/f^2 is dual to them.
  double J[2][3];
  double f[3];  // across both
  double per_square;
};

/// A in series with springs of compliance s along two directions of rotation:
/// A -= a (diag(1/s) + e^T a)^-1 a^T with a = A e.
void soften_angular(const double (&e)[2][3], const double* s, Symmetric6& A) {
  const Pairs6 a0 = A.angular_column(e[0]);
  const Pairs6 a1 = A.angular_column(e[1]);
  const double n00 = 1.0 + s[0] * along(e[0], a0);
  const double n11 = 1.0 + s[1] * along(e[1], a1);
  const double mixed = s[0] * s[1] * along(e[0], a1);
  const double k = 1.0 / (n00 * n11 - mixed * along(e[0], a1));
  const double k01 = -(k * mixed);
  A.subtract(a0, combine(k * s[0] * n11, a0, k01, a1), a1, combine(k01, a0, k * s[1] * n00, a1));
}

}  // namespace

void ArticulatedJoint::read(const Block& joint, bool child_is_a, const Vec6* u_star,
                            const double* reference) {
  const double sign = child_is_a ? 1.0 : -1.0;
  const int child = child_is_a ? joint.a : joint.b;
  const int parent = child_is_a ? joint.b : joint.a;
  const Vec3& r = child_is_a ? joint.r_a : joint.r_b;
  const Vec3& r_parent = child_is_a ? joint.r_b : joint.r_a;

  const double* u = u_star[index(child)].data();
  double speed[6];  // of the child at the pivot, from the parent
  cross(u + 3, r.data(), speed);
  for (int i = 0; i < 3; ++i) {
    speed[i] += u[i];
    speed[3 + i] = u[3 + i];
  }
  if (parent >= 0) {
    const double* u_parent = u_star[index(parent)].data();
    double at_pivot[3];
    cross(u_parent + 3, r_parent.data(), at_pivot);
    for (int i = 0; i < 3; ++i) {
      speed[i] -= u_parent[i] + at_pivot[i];
      speed[3 + i] -= u_parent[3 + i];
    }
  }
  rows_ = joint.rows;
  sign_ = sign;
  double softness = 0.0;  // sum over rows; none is negative
  for (int row = 0; row < joint.rows; ++row) softness += joint.softness[row];
  exact_ = softness == 0.0;
  for (int i = 0; i < 3; ++i) {
    r_[i] = r[i];
    to_parent_[i] = (reference != nullptr ? reference[i] : 0.0) - r_parent[i];
    d_[i] = speed[i] + sign * joint.bias[i];
  }
  if (joint.rows == 3) {
    for (int k = 0; k < 3; ++k) {
      d_[3 + k] = 0.0;
      for (int i = 0; i < 3; ++i) free_[k].f[i] = i == k ? 1.0 : 0.0;
    }
  } else {
    // The free axis is perpendicular to both angular rows; the dual vectors lie in their plane.
    const AngularRows rows(joint);
    const double w0 = dot(rows.J[0], speed + 3) + sign * joint.bias[3];
    const double w1 = dot(rows.J[1], speed + 3) + sign * joint.bias[4];
    double across[3];
    double d[3];
    for (int i = 0; i < 3; ++i) {
      free_[0].f[i] = rows.f[i];
      across[i] = w0 * rows.J[1][i] - w1 * rows.J[0][i];
    }
    cross(across, rows.f, d);
    for (int i = 0; i < 3; ++i) d_[3 + i] = d[i] * rows.per_square;
    if (exact_) return;
    cross(rows.J[1], rows.f, e_[0]);
    cross(rows.f, rows.J[0], e_[1]);
    for (double(&e)[3] : e_) {
      for (double& component : e) component *= rows.per_square;
    }
    w_[3] = w0;
    w_[4] = w1;
  }
  if (exact_) return;
  for (int i = 0; i < 3; ++i) w_[i] = d_[i];
  for (int row = 0; row < joint.rows; ++row) softness_[row] = joint.softness[row];
}

template <int rows>
void ArticulatedJoint::eliminate_rows(Symmetric6& A) {
  for (int k = 0; k < n_free(rows); ++k) {
    const Pairs6 column = A.angular_column(free_[k].f);
    const double inverse = 1.0 / along(free_[k].f, column);
    A.subtract(combine(inverse, column), column);
    free_[k].column = column;
    free_[k].inverse = inverse;
  }
  if (exact_) return;
  const double* s = softness_;
  if (s[0] != 0.0 || s[1] != 0.0 || s[2] != 0.0) A.soften_linear(s);
  if (rows == 5 && (s[3] != 0.0 || s[4] != 0.0)) soften_angular(e_, s + 3, A);
}

void ArticulatedJoint::eliminate_from(const InverseMass& W, const Square6& carried) {
  Symmetric6 A = add_inertia(W, r_, carried);
  if (rows_ == 5) {
    eliminate_rows<5>(A);
  } else {
    eliminate_rows<3>(A);
  }
  A.rows(P_);
}

void ArticulatedJoint::eliminate(const InverseMass& W, const Square6& carried) {
  eliminate_from(W, carried);
}

void ArticulatedJoint::eliminate(const InverseMass& W, const ArticulatedJoint& carried) {
  Square6 left;
  carried.left(left);
  eliminate_from(W, left);
}

// A body's vectors stay in registers throughout each function.

// For exact rows y follows from w alone, without dependence on earlier results.
template <int rows, bool exact>
void ArticulatedJoint::forward_rows(const double* g_centre, double* g_parent) {
  double torque[3];
  double g[6];
  for (int i = 0; i < 6; ++i) {
    g[i] = handed_[i];
    handed_[i] = 0.0;
  }
  if (g_centre != nullptr) {
    cross(r_, g_centre, torque);
    for (int i = 0; i < 3; ++i) {
      g[i] += g_centre[i];
      g[3 + i] += g_centre[3 + i] - torque[i];
    }
  }
  for (int k = 0; k < n_free(rows); ++k) {
    Free& free = free_[k];
    free.momentum = dot(free.f, g + 3);
    const double q = free.inverse * free.momentum;
    for (int i = 0; i < 6; ++i) g[i] -= free.column[i] * q;
  }
  double d[6];  // E w - Sigma g1
  if (exact) {
    for (int i = 0; i < 6; ++i) d[i] = d_[i];
  } else {
    for (int i = 0; i < 3; ++i) {
      d[i] = w_[i] - softness_[i] * g[i];
      d[3 + i] = 0.0;
    }
    for (int row = 3; row < rows; ++row) {
      const double* e = e_[row - 3];
      const double y = w_[row] - softness_[row] * dot(e, g + 3);
      for (int i = 0; i < 3; ++i) d[3 + i] += e[i] * y;
    }
  }
  const Pairs6 handed = P_.times(d);
  for (int i = 0; i < 6; ++i) {
    g[i] += handed[i];
    g_[i] = g[i];
  }
  if (g_parent == nullptr) return;
  cross(to_parent_, g, torque);
  for (int i = 0; i < 3; ++i) {
    g_parent[i] += g[i];
    g_parent[3 + i] += g[3 + i] - torque[i];
  }
}

void ArticulatedJoint::forward(const double* g_centre, double* g_parent) {
  if (rows_ == 5) {
    exact_ ? forward_rows<5, true>(g_centre, g_parent) : forward_rows<5, false>(g_centre, g_parent);
  } else {
    exact_ ? forward_rows<3, true>(g_centre, g_parent) : forward_rows<3, false>(g_centre, g_parent);
  }
}

// The parent's velocity at the pivot.
inline void ArticulatedJoint::at_pivot(const double* v_parent, double (&v)[6]) const {
  if (v_parent == nullptr) {
    for (double& component : v) component = 0.0;
    return;
  }
  cross(to_parent_, v_parent + 3, v);
  for (int i = 0; i < 3; ++i) {
    v[i] += v_parent[i];
    v[3 + i] = v_parent[3 + i];
  }
}

// R of the derivation. @param v at_pivot()
inline void ArticulatedJoint::pass_velocity(const double* v_parent, const double (&v)[6],
                                            double (&R)[6]) const {
  if (v_parent == nullptr) {
    for (int i = 0; i < 6; ++i) R[i] = -g_[i];
    return;
  }
  const Pairs6 carried = P_.times(v);
  for (int i = 0; i < 6; ++i) R[i] = carried[i] - g_[i];
}

template <int rows, bool exact>
void ArticulatedJoint::backward_rows(const double* v_parent, double* v_centre) {
  double v[6];
  at_pivot(v_parent, v);
  if (exact) {
    for (int i = 0; i < (rows == 3 ? 3 : 6); ++i) v[i] -= d_[i];
  } else {
    double R[6];
    pass_velocity(v_parent, v, R);
    for (int i = 0; i < 3; ++i) v[i] -= w_[i] + softness_[i] * R[i];
    for (int row = 3; row < rows; ++row) {
      const double* e = e_[row - 3];
      const double y = w_[row] + softness_[row] * dot(e, R + 3);
      for (int i = 0; i < 3; ++i) v[3 + i] -= e[i] * y;
    }
  }
  for (int k = n_free(rows); k-- > 0;) {
    const Free& free = free_[k];
    const Pairs6& a = free.column;
    const double sum =
        (a[0] * v[0] + a[1] * v[1] + a[2] * v[2]) + (a[3] * v[3] + a[4] * v[4] + a[5] * v[5]);
    const double q = free.inverse * (free.momentum - sum);
    for (int i = 0; i < 3; ++i) v[3 + i] += free.f[i] * q;
  }
  for (int i = 0; i < 6; ++i) v_[i] = v[i];
  double turned[3];
  cross(r_, v + 3, turned);
  for (int i = 0; i < 3; ++i) {
    v_centre[i] = turned[i] + v[i];
    v_centre[3 + i] = v[3 + i];
  }
}

void ArticulatedJoint::backward(const double* v_parent, double* v_centre) {
  if (rows_ == 5) {
    exact_ ? backward_rows<5, true>(v_parent, v_centre)
           : backward_rows<5, false>(v_parent, v_centre);
  } else {
    exact_ ? backward_rows<3, true>(v_parent, v_centre)
           : backward_rows<3, false>(v_parent, v_centre);
  }
}

void ArticulatedJoint::find_impulse(const double* v_parent, Block& joint) const {
  double v[6];
  double R[6];
  at_pivot(v_parent, v);
  pass_velocity(v_parent, v, R);
  for (double& component : R) component *= sign_;
  for (int row = 0; row < 3; ++row) joint.impulse[row] = R[row];
  if (joint.rows == 3) return;
  const AngularRows rows(joint);
  double turned[3];
  cross(rows.f, R + 3, turned);
  joint.impulse[3] = dot(rows.J[1], turned) * rows.per_square;
  joint.impulse[4] = -(dot(rows.J[0], turned) * rows.per_square);
}

}  // namespace substep
