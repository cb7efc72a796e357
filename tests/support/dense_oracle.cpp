#include "tests/support/dense_oracle.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace substep::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solved(const MatrixXd& A, const VectorXd& b) { return A.partialPivLu().solve(b); }
VectorXd least_squares(const MatrixXd& A, const VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}
MatrixXd inverse(const MatrixXd& A) { return A.partialPivLu().inverse(); }

double spectral_radius(const MatrixXd& A) {
  return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues().cwiseAbs().maxCoeff();
}

double largest_eigenvalue(const MatrixXd& K, const MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(K, M, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[K.rows() - 1];
}

}  // namespace substep::test
