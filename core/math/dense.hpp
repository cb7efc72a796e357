#pragma once
// Dense linear algebra of any size as plain functions, which are compiled once: Eigen's products
// and decompositions of dynamic matrices take seconds to compile in each file that uses them.

#include <Eigen/Core>

namespace substep {

using AnyMatrix = Eigen::MatrixXd;
using AnyVector = Eigen::VectorXd;

/// A B
AnyMatrix product(const AnyMatrix& A, const AnyMatrix& B);
/// A^T B
AnyMatrix transposed_product(const AnyMatrix& A, const AnyMatrix& B);
/// A x
AnyVector product(const AnyMatrix& A, const AnyVector& x);
/// A^T x
AnyVector transposed_product(const AnyMatrix& A, const AnyVector& x);
/// sum += factor x x^T
void add_square(AnyMatrix& sum, double factor, const AnyVector& x);

/// The factor of a symmetric positive definite matrix M = L L^T, of which the lower half is read.
/// Of another matrix the results are meaningless.
class Cholesky {
 public:
  explicit Cholesky(const AnyMatrix& M);
  /// M^-1 b
  [[nodiscard]] AnyVector solve(const AnyVector& b) const;
  /// L^-1 B
  [[nodiscard]] AnyMatrix solve_lower(const AnyMatrix& B) const;
  /// L^-T b
  [[nodiscard]] AnyVector solve_upper(const AnyVector& b) const;

 private:
  AnyMatrix L_;
};

/// The eigenvector of length 1 that belongs to the smallest eigenvalue of a symmetric matrix.
AnyVector eigenvector_of_smallest(const AnyMatrix& symmetric);

/// x of least norm that minimises |A x - b|. @param threshold pivots below it, relative to the
/// largest, count as zero
AnyVector least_norm_solution(const AnyMatrix& A, const AnyVector& b, double threshold);

/// An orthonormal basis, in columns, of the vectors that are orthogonal to all columns of a matrix.
/// @param threshold as above
AnyMatrix orthogonal_complement(const AnyMatrix& columns, double threshold);

}  // namespace substep
