// Dense linear algebra, against the properties that define each result.

#include "core/math/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/turn.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

constexpr double kNegligiblePivot = 1e-9;

AnyMatrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  AnyMatrix A(rows, columns);
  for (double& number : A.reshaped()) number = uniform(random);
  return A;
}

/// Of a rank, symmetric and positive semidefinite.
AnyMatrix random_square(Random& random, Eigen::Index size, Eigen::Index rank) {
  const AnyMatrix half = random_matrix(random, rank, size);
  return transposed_product(half, half);
}

TEST(Dense, CholeskySolvesWithEachOfItsFactors) {
  Random random(3);
  for (Eigen::Index n = 1; n < 12; ++n) {
    AnyMatrix M = random_square(random, n, n + 2);
    const AnyVector b = random_matrix(random, n, 1);
    const Cholesky factor(M);
    EXPECT_LT((product(M, factor.solve(b)) - b).norm(), 1e-9);
    const AnyMatrix half = factor.solve_lower(M);  // L^T
    EXPECT_LT((transposed_product(half, half) - M).norm(), 1e-12 * M.norm());
    EXPECT_LT((product(half, factor.solve_upper(b)) - b).norm(), 1e-9);
    AnyMatrix upper_lost = M;  // only the lower half is read
    upper_lost.triangularView<Eigen::StrictlyUpper>().setConstant(kUnbounded);
    EXPECT_EQ(Cholesky(upper_lost).solve(b), factor.solve(b));
  }
}

TEST(Dense, TheEigenvectorOfTheSmallestMinimisesTheQuotient) {
  Random random(4);
  for (Eigen::Index n = 1; n < 10; ++n) {
    const AnyMatrix A = random_square(random, n, n) - AnyMatrix::Identity(n, n);
    const AnyVector x = eigenvector_of_smallest(A);
    const double value = x.dot(product(A, x));
    EXPECT_NEAR(x.norm(), 1.0, 1e-12);
    EXPECT_LT((product(A, x) - value * x).norm(), 1e-12 * (1.0 + A.norm()));
    for (int trial = 0; trial < 100; ++trial) {
      const AnyVector other = AnyVector(random_matrix(random, n, 1)).normalized();
      EXPECT_GE(other.dot(product(A, other)), value - 1e-12);
    }
  }
}

// A consistent system of lower rank: it is solved, and the solution has no part in the null space.
TEST(Dense, TheLeastNormSolutionHasNoPartInTheNullSpace) {
  Random random(5);
  for (Eigen::Index rank = 1; rank < 8; ++rank) {
    const Eigen::Index n = rank + rank % 3;
    const AnyMatrix S = random_square(random, n, rank);
    const AnyVector b = product(S, AnyVector(random_matrix(random, n, 1)));
    const AnyVector x = least_norm_solution(S, b, kNegligiblePivot);
    EXPECT_LT((product(S, x) - b).norm(), 1e-9 * (1.0 + b.norm()));
    const AnyMatrix null = orthogonal_complement(S, kNegligiblePivot);
    EXPECT_EQ(null.cols(), n - rank);
    EXPECT_LT(transposed_product(null, x).norm(), 1e-9 * (1.0 + x.norm()));
  }
}

TEST(Dense, TheComplementIsOrthonormalAndOrthogonalToTheColumns) {
  Random random(6);
  for (Eigen::Index columns = 0; columns < 6; ++columns) {
    AnyMatrix A = random_matrix(random, 7, columns);
    if (columns > 2) A.col(1) = 2.0 * A.col(0);
    const AnyMatrix Z = orthogonal_complement(A, kNegligiblePivot);
    EXPECT_EQ(Z.cols(), 7 - columns + (columns > 2 ? 1 : 0));
    EXPECT_LT((transposed_product(Z, Z) - AnyMatrix::Identity(Z.cols(), Z.cols())).norm(), 1e-12);
    EXPECT_LT(transposed_product(Z, A).norm(), 1e-12 * (1.0 + A.norm()));
  }
}

TEST(Dense, ProductsAndSquares) {
  Random random(7);
  const AnyMatrix A = random_matrix(random, 4, 3);
  const AnyMatrix B = random_matrix(random, 3, 5);
  const AnyVector x = random_matrix(random, 3, 1);
  AnyMatrix square = AnyMatrix::Identity(3, 3);
  add_square(square, 2.5, x);
  for (Eigen::Index i = 0; i < 4; ++i) {
    EXPECT_NEAR(product(A, x)[i], A.row(i).dot(x), 1e-14);
    for (Eigen::Index j = 0; j < 5; ++j) {
      EXPECT_NEAR(product(A, B)(i, j), A.row(i).dot(B.col(j)), 1e-14);
    }
  }
  EXPECT_LT((transposed_product(A, A) - product(AnyMatrix(A.transpose()), A)).norm(), 1e-14);
  EXPECT_LT((transposed_product(B, x) - product(AnyMatrix(B.transpose()), x)).norm(), 1e-14);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      EXPECT_NEAR(square(i, j), (i == j ? 1.0 : 0.0) + 2.5 * x[i] * x[j], 1e-14);
    }
  }
}

// In space, of any length, nearly equal and nearly opposite: about an axis across both.
TEST(Turn, BetweenTwoDirectionsIsTheShortest) {
  Random random(8);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 from = 3.0 * random_vector(random);
    const Vec3 across = from.cross(random_vector(random)).normalized();
    const double away = std::pow(10.0, uniform(random, -9.0, 0.0));
    const Vec3 to = trial % 3 == 0   ? random_vector(random)
                    : trial % 3 == 1 ? Vec3(-from + away * across)
                                     : Vec3(from + away * across);
    const Quat turn = turn_between(from, to);
    EXPECT_NEAR(turn.norm(), 1.0, 1e-14);
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-7);
    EXPECT_LT(std::abs(turn.vec().dot(from.normalized())), 1e-9);
    EXPECT_GE(turn.w(), 0.0);
  }
  EXPECT_EQ(turn_between(Vec3::UnitX(), Vec3::UnitX()).vec(), Vec3::Zero());
  const Vec3 back = turn_between(Vec3::UnitX(), -Vec3::UnitX()) * Vec3::UnitX();
  EXPECT_LT((back + Vec3::UnitX()).norm(), 1e-14);
}

}  // namespace
}  // namespace substep::test
