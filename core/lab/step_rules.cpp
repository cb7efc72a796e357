#include "core/lab/step_rules.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/dense.hpp"

namespace substep {

bool is_stable(const OneCoordinate& of, double h) {
  return h * h * of.stiffness + 2.0 * h * of.explicit_damping <
         4.0 * of.inertia + 2.0 * h * of.implicit_damping;
}

// The positive root of k h^2 + 2 d h - 4 I, d = d_e - d_i.
double largest_step(const OneCoordinate& of) {
  const double d = of.explicit_damping - of.implicit_damping;
  const double root = std::sqrt(d * d + 4.0 * of.stiffness * of.inertia);
  if (d > 0.0) return 4.0 * of.inertia / (d + root);
  return of.stiffness > 0.0 ? (root - d) / of.stiffness : kNoLimit;
}

bool is_stable(const HeldDrive& of, double h) {
  return of.steps * h * (h * of.stiffness + 2.0 * of.damping) < 4.0 * of.inertia &&
         of.damping > 0.5 * of.stiffness * h * (of.steps - 1);
}

double largest_step_of_effort(const HeldDrive& of) {
  return largest_step(OneCoordinate{of.inertia, of.steps * of.stiffness, of.steps * of.damping});
}

double largest_step_of_delay(const HeldDrive& of) {
  if (of.steps == 1 || of.stiffness == 0.0) return kNoLimit;
  return 2.0 * of.damping / (of.stiffness * (of.steps - 1));
}

double armature_for(const OneCoordinate& of, double h) {
  const double damping = of.explicit_damping - of.implicit_damping;
  return std::max(0.0, 0.25 * h * h * of.stiffness + 0.5 * h * damping - of.inertia);
}

namespace {

/// The larger root s of 4 s^2 + 2 s b - a, or 0 if it is not negative anywhere above 0.
double larger_root(double a, double b) {
  const double square = b * b + 4.0 * a;
  return square > 0.0 ? std::max(0.0, 0.25 * (std::sqrt(square) - b)) : 0.0;
}

}  // namespace

// With s = 1/h and M = L L^T, A = L^-1 K L^-T, B = L^-1 D L^-T: 4 s^2 + 2 s B - A > 0. s becomes
// the larger root of x . (4 s^2 + 2 s B - A) x for the x that fails first, and rises until none
// fails.
StepLimit largest_step(const LinearSystem& of) {
  StepLimit limit;
  if (of.mass.rows() == 0) return limit;
  const Cholesky factor(of.mass);
  const auto reduced = [&](const AnyMatrix& matrix) {
    const AnyMatrix both = factor.solve_lower(factor.solve_lower(matrix).transpose());
    return AnyMatrix(0.5 * (both + both.transpose()));
  };
  const AnyMatrix A = reduced(of.stiffness);
  const bool damped = of.damping.size() > 0;
  const AnyMatrix B = damped ? reduced(of.damping) : AnyMatrix();
  constexpr double kRounding = 1e-14;
  double s = 0.0;
  const auto rises = [&](const AnyVector& x) {
    const double root = larger_root(x.dot(product(A, x)), damped ? x.dot(product(B, x)) : 0.0);
    if (!(root > s * (1.0 + kRounding))) return false;
    s = root;
    limit.mode = factor.solve_upper(x);
    return true;
  };
  rises(eigenvector_of_smallest(-A));
  if (damped) {
    constexpr int kMostRounds = 100;
    rises(eigenvector_of_smallest(B));
    for (int i = 0; i < kMostRounds; ++i) {
      AnyMatrix P = 2.0 * s * B - A;
      P.diagonal().array() += 4.0 * s * s;
      if (!rises(eigenvector_of_smallest(P))) break;
    }
  }
  if (s > 0.0) limit.step = 1.0 / s;
  return limit;
}

}  // namespace substep
