#include "core/stepping/full_stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace substep {

Mat3 resisting(const Mat3& K) {
  const Mat3 symmetric = -0.5 * (K + K.transpose());
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
  const Mat3& V = eigen.eigenvectors();
  Mat3 out = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    out += std::max(0.0, eigen.eigenvalues()[i]) * V.col(i) * V.col(i).transpose();
  }
  return out;
}

}  // namespace substep
