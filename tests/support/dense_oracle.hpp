#pragma once
// Decompositions of dense matrices for tests, compiled once: in each file they take seconds.

#include <Eigen/Core>

namespace substep::test {

/// x of A x = b, A square and regular.
Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// x that minimises |A x - b|, A of full column rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
/// The largest absolute value of an eigenvalue.
double spectral_radius(const Eigen::MatrixXd& A);
/// The largest x of K v = x M v, K symmetric and M symmetric positive definite.
double largest_eigenvalue(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

}  // namespace substep::test
