// Limits of the time step against the spectral radius of the matrices of a step.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/lab/step_rules.hpp"
#include "core/math/dense.hpp"
#include "tests/support/dense_oracle.hpp"
#include "tests/support/sanitized.hpp"

namespace substep {
namespace {

using Matrix = Eigen::MatrixXd;
using RandomBits = std::mt19937_64;

double between(RandomBits& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}
double magnitude(RandomBits& random, double least, double most) {
  return std::exp(between(random, std::log(least), std::log(most)));
}

/// (q, v) after one step of semi-implicit Euler.
Matrix step_of(const Matrix& M, const Matrix& K_e, const Matrix& K_i, const Matrix& D_e,
               const Matrix& D_i, double h) {
  const auto n = M.rows();
  const Matrix E = Matrix::Identity(n, n);
  // (M + h D_i + h^2 K_i) v+ = (M - h D_e) v - h (K_e + K_i) q
  const Matrix left = test::inverse(M + h * D_i + h * h * K_i);
  Matrix step(2 * n, 2 * n);
  step.bottomLeftCorner(n, n) = -h * product(left, Matrix(K_e + K_i));
  step.bottomRightCorner(n, n) = product(left, Matrix(M - h * D_e));
  step.topLeftCorner(n, n) = E + h * step.bottomLeftCorner(n, n);
  step.topRightCorner(n, n) = h * step.bottomRightCorner(n, n);
  return step;
}

Matrix one(double x) { return Matrix::Constant(1, 1, x); }

// Steps from half to twice the limit; those within 1e-6 of it are skipped.
TEST(StepRules, OfOneCoordinateAreExact) {
  RandomBits random(1);
  int stable = 0;
  for (int i = 0; i < 20000; ++i) {
    const OneCoordinate of{magnitude(random, 1e-4, 1e2), magnitude(random, 1e-2, 1e5),
                           random() % 2 ? 0.0 : magnitude(random, 1e-3, 1e2),
                           random() % 2 ? 0.0 : magnitude(random, 1e-3, 1e2)};
    const double limit = largest_step(of);
    const double share = magnitude(random, 0.5, 2.0);
    if (std::abs(share - 1.0) < 1e-6) continue;
    const double h = share * limit;
    const Matrix step = step_of(one(of.inertia), one(of.stiffness), one(0.0),
                                one(of.explicit_damping), one(of.implicit_damping), h);
    const double radius = test::spectral_radius(step);
    // Without damping the roots are on the unit circle.
    EXPECT_EQ(radius < 1.0 + 1e-9, share < 1.0) << radius << " " << share;
    EXPECT_EQ(is_stable(of, h), share < 1.0);
    stable += share < 1.0;
  }
  EXPECT_GT(stable, 8000);
}

TEST(StepRules, OfAHeldDriveAreExact) {
  RandomBits random(2);
  int by_delay = 0;
  for (int i = 0; i < 20000; ++i) {
    const HeldDrive of{magnitude(random, 1e-3, 1e1), magnitude(random, 1.0, 1e4),
                       magnitude(random, 1e-2, 1e2), 1 + static_cast<int>(random() % 8)};
    const double effort = largest_step_of_effort(of);
    const double delay = largest_step_of_delay(of);
    const double h = magnitude(random, 0.5, 2.0) * std::min(effort, delay);
    if (std::abs(h / effort - 1.0) < 1e-6 || std::abs(h / delay - 1.0) < 1e-6) continue;
    Matrix all = Matrix::Identity(3, 3);  // (q, v, torque)
    all.row(2) << -of.stiffness, -of.damping, 0.0;
    Matrix step = Matrix::Identity(3, 3);
    step(1, 2) = h / of.inertia;
    step(0, 1) = h;
    step(0, 2) = h * h / of.inertia;
    for (int k = 0; k < of.steps; ++k) all = product(step, all);
    const double radius = test::spectral_radius(
        product(Matrix(all.topLeftCorner(3, 2)), Matrix(Matrix::Identity(2, 3))));
    EXPECT_EQ(radius < 1.0, is_stable(of, h))
        << radius << " " << h / effort << " " << h / delay << " " << of.steps;
    by_delay += delay < effort;
  }
  EXPECT_GT(by_delay, 1000);
}

Matrix random_positive(RandomBits& random, Eigen::Index n, Eigen::Index rank) {
  const Matrix A = Matrix::NullaryExpr(n, rank, [&] { return between(random, -1.0, 1.0); });
  return product(A, Matrix(A.transpose()));
}

// Several joints, all four kinds of terms.
TEST(StepRules, OfSeveralCoordinatesAreExact) {
  RandomBits random(3);
  for (int i = 0; i < repetitions(20000, 2000); ++i) {
    const auto n = static_cast<Eigen::Index>(2 + random() % 4);
    const Matrix M = random_positive(random, n, n) + 0.1 * Matrix::Identity(n, n);
    const Matrix K_e = 100.0 * (random_positive(random, n, n) + 0.01 * Matrix::Identity(n, n));
    const Matrix zero = Matrix::Zero(n, n);
    const auto any = [&](double size) {
      return random() % 2 ? zero : Matrix(size * random_positive(random, n, 1 + n / 2));
    };
    const Matrix K_i = any(30.0);
    const Matrix D_e = any(5.0);
    const Matrix D_i = any(5.0);
    const StepLimit limit = largest_step(LinearSystem{M, K_e - K_i, D_i - D_e});
    if (limit.step == kNoLimit) continue;
    const double share = magnitude(random, 0.5, 2.0);
    if (std::abs(share - 1.0) < 1e-6) continue;
    const double radius = test::spectral_radius(step_of(M, K_e, K_i, D_e, D_i, share * limit.step));
    if (share < 1.0) {
      EXPECT_LT(radius, 1.0 + 1e-7) << share;
    } else if (D_e.isZero(0.0)) {
      // With explicit damping and implicit stiffness, larger steps can be stable again.
      EXPECT_GT(radius, 1.0) << share;
    } else {
      EXPECT_GT(test::spectral_radius(step_of(M, K_e, K_i, D_e, D_i, (1.0 + 1e-6) * limit.step)),
                1.0 - 1e-7);
    }
    const Matrix P =
        4.0 * M + 2.0 * limit.step * (D_i - D_e) - limit.step * limit.step * (K_e - K_i);
    EXPECT_LT(product(P, limit.mode).norm(), 1e-6 * P.norm() * limit.mode.norm());
    EXPECT_NEAR(limit.mode.dot(product(M, limit.mode)), 1.0, 1e-9);
  }
}

// The drive of mujoco's thread: inertia 0.1005, kp 2000, kv 200, joint damping 1; PD with kp 100.
TEST(StepRules, OfKnownDrives) {
  EXPECT_NEAR(largest_step(OneCoordinate{0.1005, 2000.0, 200.0, 1.0}), 1.0e-3, 1e-5);
  EXPECT_NEAR(largest_step(OneCoordinate{0.1005, 2000.0, 0.0, 201.0}), 0.20, 5e-3);
  const double n_4 = 100.0 * 0.005 * 3.0 / 2.0;
  EXPECT_NEAR(largest_step_of_delay({1.0, 100.0, n_4, 4}), 0.005, 1e-12);
  const OneCoordinate bare{0.01, 1e4, 5.0, 0.0};
  const double armature = armature_for(bare, 0.01);
  EXPECT_NEAR(largest_step(OneCoordinate{0.01 + armature, 1e4, 5.0, 0.0}), 0.01, 1e-9);
  EXPECT_EQ(armature_for(bare, 1e-4), 0.0);
  EXPECT_EQ(largest_step(OneCoordinate{1.0, 0.0, 0.0, 2.0}), kNoLimit);
  EXPECT_DOUBLE_EQ(largest_step(OneCoordinate{1.0, 0.0, 4.0, 2.0}), 1.0);
  EXPECT_EQ(largest_step(LinearSystem{one(1.0), one(-3.0), {}}).step, kNoLimit);
  EXPECT_DOUBLE_EQ(largest_step(LinearSystem{one(1.0), one(0.0), one(-2.0)}).step, 1.0);
}

}  // namespace
}  // namespace substep
