#include "core/math/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace substep {

AnyMatrix product(const AnyMatrix& A, const AnyMatrix& B) { return A * B; }
AnyMatrix transposed_product(const AnyMatrix& A, const AnyMatrix& B) { return A.transpose() * B; }
AnyVector product(const AnyMatrix& A, const AnyVector& x) { return A * x; }
AnyVector transposed_product(const AnyMatrix& A, const AnyVector& x) { return A.transpose() * x; }

void add_square(AnyMatrix& sum, double factor, const AnyVector& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i) sum.col(i) += (factor * x[i]) * x;
}

Cholesky::Cholesky(const AnyMatrix& M) : L_(M) { Eigen::LLT<Eigen::Ref<AnyMatrix>> in_place(L_); }

AnyVector Cholesky::solve(const AnyVector& b) const {
  AnyVector x = b;
  L_.triangularView<Eigen::Lower>().solveInPlace(x);
  L_.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}

AnyMatrix Cholesky::solve_lower(const AnyMatrix& B) const {
  AnyMatrix X = B;
  L_.triangularView<Eigen::Lower>().solveInPlace(X);
  return X;
}

AnyVector Cholesky::solve_upper(const AnyVector& b) const {
  AnyVector x = b;
  L_.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}

AnyVector eigenvector_of_smallest(const AnyMatrix& symmetric) {
  return Eigen::SelfAdjointEigenSolver<AnyMatrix>(symmetric).eigenvectors().col(0);
}

AnyVector least_norm_solution(const AnyMatrix& A, const AnyVector& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<AnyMatrix> factor;
  factor.setThreshold(threshold);
  factor.compute(A);
  return factor.solve(b);
}

AnyMatrix orthogonal_complement(const AnyMatrix& columns, double threshold) {
  const Eigen::Index size = columns.rows();
  AnyMatrix Q = AnyMatrix::Identity(size, size);
  if (columns.cols() == 0) return Q;
  Eigen::ColPivHouseholderQR<AnyMatrix> factor;
  factor.setThreshold(threshold);
  factor.compute(columns);
  Q.applyOnTheLeft(factor.householderQ());
  return Q.rightCols(size - factor.rank());
}

}  // namespace substep
