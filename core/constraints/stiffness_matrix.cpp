#include "core/constraints/stiffness_matrix.hpp"

#include <cmath>
#include <utility>

namespace substep {

void StiffnessMatrix::reserve(std::size_t bodies, std::size_t pairs, bool whole) {
  pairs_.reserve(bodies + 2 * pairs);
  angular_.reserve(bodies + 2 * pairs);
  if (whole) whole_.reserve(bodies + 2 * pairs);
}

void StiffnessMatrix::clear(std::size_t bodies) {
  bodies_ = bodies;
  pairs_.clear();
  for (std::size_t i = 0; i < bodies; ++i) pairs_.push_back({static_cast<int>(i), -1});
  angular_.assign(bodies, Mat3::Zero());
  whole_.clear();
}

int StiffnessMatrix::find(int row, int col) const {
  int at = col;
  while (at >= 0 && pairs_[static_cast<std::size_t>(at)].row != row) {
    at = pairs_[static_cast<std::size_t>(at)].next;
  }
  return at;
}

std::size_t StiffnessMatrix::made(int row, int col) {
  if (const int at = find(row, col); at >= 0) return static_cast<std::size_t>(at);
  const std::size_t at = pairs_.size();
  Pair& diagonal = pairs_[index(col)];
  const int next = std::exchange(diagonal.next, static_cast<int>(at));
  pairs_.push_back({row, next});
  if (whole_.empty()) {
    angular_.push_back(Mat3::Zero());
  } else {
    whole_.push_back(Mat6::Zero());
  }
  return at;
}

void StiffnessMatrix::add(int row, int col, const Mat6& block) {
  if (whole_.empty()) {
    whole_.reserve(pairs_.capacity());
    for (const Mat3& angular : angular_) {
      whole_.push_back(Mat6::Zero());
      whole_.back().bottomRightCorner<3, 3>() = angular;
    }
  }
  const std::size_t at = made(row, col);
  whole_[at] += block;
}

Mat6 StiffnessMatrix::block(int row, int col) const {
  Mat6 K = Mat6::Zero();
  const int at = find(row, col);
  if (at < 0) return K;
  if (!whole_.empty()) return whole_[static_cast<std::size_t>(at)];
  K.bottomRightCorner<3, 3>() = angular_[static_cast<std::size_t>(at)];
  return K;
}

// Norms of angular parts are invariant under rotation of the rows, so only the columns are rotated.
void StiffnessMatrix::column_norms(std::span<const int> moving, std::span<const Body> bodies,
                                   std::span<const Mat3> R_WB, bool weighted,
                                   std::span<Vec6> k) const {
  const auto add_squares = [](const auto& columns, const Mat3& R, auto&& sum) {
    const auto turned = (columns * R).eval();
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < turned.rows(); ++i) sum[c] += turned(i, c) * turned(i, c);
    }
  };
  for (const int body : moving) {
    const auto col = index(body);
    const Mat3& R = R_WB[col];
    Vec6 sum = Vec6::Zero();
    for (int e = body; e >= 0; e = pairs_[index(e)].next) {
      const auto at = index(e);
      if (whole_.empty()) {
        add_squares(angular_[at], R, sum.tail<3>());
        continue;
      }
      const Mat6& K = whole_[at];
      if (!weighted) {
        add_squares(K.leftCols<3>(), R, sum.head<3>());
        add_squares(K.rightCols<3>(), R, sum.tail<3>());
        continue;
      }
      const Body& on = bodies[index(pairs_[at].row)];
      const Body& by = bodies[col];
      if (on.is_static || by.is_static) continue;  // of infinite mass
      const Mat3 torques = (by.mass * on.inertia.cwiseInverse()).cwiseSqrt().asDiagonal() *
                           R_WB[index(pairs_[at].row)].transpose() * K.bottomLeftCorner<3, 3>();
      const Mat3 R_weighted = R * (by.inertia / on.mass).cwiseSqrt().asDiagonal();
      add_squares(K.topLeftCorner<3, 3>(), R, sum.head<3>());
      add_squares(torques, R, sum.head<3>());
      add_squares(K.topRightCorner<3, 3>(), R_weighted, sum.tail<3>());
      add_squares(K.bottomRightCorner<3, 3>(), R, sum.tail<3>());
    }
    for (int i = whole_.empty() ? 3 : 0; i < 6; ++i) sum[i] = std::sqrt(sum[i]);
    k[col] = sum;
  }
}

}  // namespace substep
