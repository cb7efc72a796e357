#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/types.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The assembled geometric stiffness K = d(J^T lambda)/dq (Eq. 1) in 6 x 6 blocks, world axes:
/// rows are forces on a body, columns displacements of a body. Blocks of one pair of bodies are
/// summed before any norm is taken. Joints and the paper's contacts contribute only angular parts;
/// whole blocks are allocated when another term is added.
class StiffnessMatrix {
 public:
  /// @param whole whether whole blocks may first be added after the first frame
  void reserve(std::size_t bodies, std::size_t pairs, bool whole);
  /// Resets to zero, for this many bodies.
  void clear(std::size_t bodies);
  /// Adds to the angular-angular part. @param block [N m/rad]
  void add_angular(int row, int col, const Mat3& block) {
    const std::size_t at = made(row, col);
    if (whole_.empty()) {
      angular_[at] += block;
    } else {
      whole_[at].bottomRightCorner<3, 3>() += block;
    }
  }
  /// Adds a whole block. @param block [N/m, N/rad; N, N m/rad]
  void add(int row, int col, const Mat6& block);

  /// K_d (Eq. 4): the 2-norm of every column, along the body's principal axes.
  /// @param weighted torques by a translation and forces by a rotation are weighted as in
  /// M^-1/2 K M^-1/2, so that the unit of length does not matter
  /// @param moving bodies whose columns are evaluated  @param bodies all, with R_WB their rotations
  /// @param k out, 6 per body [N/m, N m/rad], >= 0
  void column_norms(std::span<const int> moving, std::span<const Body> bodies,
                    std::span<const Mat3> R_WB, bool weighted, std::span<Vec6> k) const;

  [[nodiscard]] std::size_t bodies() const { return bodies_; }
  /// Number of blocks, zero ones on the diagonal included.
  [[nodiscard]] std::size_t blocks() const { return pairs_.size(); }
  /// Rows of a block: 3 if only the angular parts are kept.
  [[nodiscard]] std::int64_t block_size() const { return whole_.empty() ? 3 : 6; }

  /// The block of one pair; zero if absent.
  [[nodiscard]] Mat6 block(int row, int col) const;
  /// Derivative of a body's torque by its own rotation: the angular part of its diagonal block.
  [[nodiscard]] Mat3 angular(int body) const {
    const auto at = static_cast<std::size_t>(body);
    return whole_.empty() ? angular_[at] : Mat3(whole_[at].bottomRightCorner<3, 3>());
  }

 private:
  /// A pair of bodies with a block: first the diagonal in order of bodies, then others in order of
  /// insertion.
  struct Pair {
    int row = 0;
    int next = -1;  // next pair of the same column
  };
  /// Index of a pair's block, -1 if absent.
  [[nodiscard]] int find(int row, int col) const;
  /// The same; inserts the block if absent.
  std::size_t made(int row, int col);

  std::vector<Pair> pairs_;
  std::vector<Mat3> angular_;  // parallel to pairs_, while whole_ is empty
  std::vector<Mat6> whole_;    // parallel to pairs_, or empty
  std::size_t bodies_ = 0;
};

}  // namespace substep
