#include "core/constraints/stiffness_matrix.hpp"

#include <cmath>

namespace substep {

void StiffnessMatrix::reserve(std::size_t bodies, std::size_t pairs) {
  diagonal_.reserve(bodies);
  first_.reserve(bodies);
  entries_.reserve(2 * pairs);
}

void StiffnessMatrix::clear(std::size_t bodies) {
  diagonal_.assign(bodies, Mat6::Zero());
  first_.assign(bodies, -1);
  entries_.clear();
}

Mat6& StiffnessMatrix::at(int row, int col) {
  const auto c = static_cast<std::size_t>(col);
  if (row == col) return diagonal_[c];
  for (int e = first_[c]; e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
    Entry& entry = entries_[static_cast<std::size_t>(e)];
    if (entry.row == row) return entry.K;
  }
  entries_.push_back({row, first_[c], Mat6::Zero()});
  first_[c] = static_cast<int>(entries_.size()) - 1;
  return entries_.back().K;
}

Mat6 StiffnessMatrix::block(int row, int col) const {
  const auto c = static_cast<std::size_t>(col);
  if (row == col) return diagonal_[c];
  for (int e = first_[c]; e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
    const Entry& entry = entries_[static_cast<std::size_t>(e)];
    if (entry.row == row) return entry.K;
  }
  return Mat6::Zero();
}

// Of every block its columns are turned, squared and summed; of every column one root is taken.
std::int64_t StiffnessMatrix::norm_flops() const {
  constexpr std::int64_t kOfBlock = 2 * 6 * 3 * (3 + 2) + 2 * 6 * 6;
  const auto bodies = static_cast<std::int64_t>(diagonal_.size());
  return (bodies + static_cast<std::int64_t>(entries_.size())) * kOfBlock + 6 * bodies;
}

void StiffnessMatrix::column_norms(std::span<const Mat3> R_WB, std::span<Vec6> k) const {
  // A norm does not change with the axes of the rows, so only the columns are turned.
  const auto add_squares = [](const Mat6& K, const Mat3& R, Vec6& sum) {
    const Eigen::Matrix<double, 6, 3> linear = K.leftCols<3>() * R;
    const Eigen::Matrix<double, 6, 3> angular = K.rightCols<3>() * R;
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < 6; ++i) {
        sum[c] += linear(i, c) * linear(i, c);
        sum[3 + c] += angular(i, c) * angular(i, c);
      }
    }
  };
  for (std::size_t col = 0; col < diagonal_.size(); ++col) {
    Vec6 sum = Vec6::Zero();
    add_squares(diagonal_[col], R_WB[col], sum);
    for (int e = first_[col]; e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
      add_squares(entries_[static_cast<std::size_t>(e)].K, R_WB[col], sum);
    }
    for (int i = 0; i < 6; ++i) k[col][i] = std::sqrt(sum[i]);
  }
}

}  // namespace substep
