// Iterative refinement after clamped pivots.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/solver/saddle_ldlt.hpp"

namespace substep {

namespace {

constexpr int kMostCorrections = 12;   // corrections
constexpr double kFalls = 0.5;         // required reduction of |w| per correction
constexpr double kChange = 1e-2;       // largest relative change of velocities by a correction
constexpr double kAttainable = 1e-15;  // relative to the velocities: attainable accuracy

/// The largest speed of a body [m/s].
double largest_of(std::span<const Vec6> u, std::span<const InverseMass> inverse_mass) {
  double square = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    square = std::max(square, speed_squared(u[i], gyration_squared(inverse_mass[i])));
  }
  return std::sqrt(square);
}

/// True if two sets of velocities are close. False with NaN.
bool is_near(std::span<const Vec6> u, std::span<const Vec6> v,
             std::span<const InverseMass> inverse_mass) {
  const double largest = kChange * largest_of(v, inverse_mass);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double square = speed_squared(u[i] - v[i], gyration_squared(inverse_mass[i]));
    if (!(square <= largest * largest)) return false;
  }
  return true;
}

/// Radius of gyration of the larger body, by which angular rows count as speeds [m].
double length_of(const Block& block, std::span<const InverseMass> inverse_mass) {
  double square = 0.0;
  for (const int body : {block.a, block.b}) {
    if (body >= 0) square = std::max(square, gyration_squared(inverse_mass[index(body)]));
  }
  return std::sqrt(square);
}

}  // namespace

double SaddleLdlt::start_correction(const System& system) {
  copy(u_begun_, u_star_);
  for (const Block& block : system.blocks) {
    apply_impulse(block, block.impulse, system.inverse_mass, u_star_);
  }
  double largest = 0.0;
  for (Block& block : system.blocks) {
    double w[kMaxRows];
    row_speeds(block, u_star_, w);
    const double length = length_of(block, system.inverse_mass);
    for (int row = 0; row < block.rows; ++row) {
      block.bias[row] += block.softness[row] * block.impulse[row];
      const double left = std::abs(w[row] + block.bias[row]);
      largest = std::max(largest, row < block.position_rows ? left : length * left);
      block.impulse[row] = 0.0;
    }
    flops_ += residual_flops(block);
  }
  return largest;
}

// All rows of loops become springs, w = J u+ + s x + bias = -e x with e a share of their mobility,
// and the impulses are a starting point: with x = x0 + d and u0 = u* + Mt^-1 J^T x0, the remaining
// d solves
//   J (u0 + Mt^-1 J^T d) + s d + (bias + s x0) = 0,
// with the same factor. The error falls by the ratio of e to the row's effective J Mt^-1 J^T in the
// whole system, slowly only close to a singular pose. With contradictory rows it does not fall, or
// the solution would change strongly; then the softened solution is kept.
void SaddleLdlt::refine(const System& system) {
  found_.resize(system.blocks.size());
  u_begun_.resize(u_star_.size());
  u_earlier_.resize(u_star_.size());
  if (std::exchange(refined_, true)) {  // another bias for the same system
    copy(system.u, u_star_);
    read(system.blocks);
  }
  soften_all(redundant_ == Redundant::kVelocities ? kSoftened : kShared);
  solve(system);
  correct(system);
  copy(u_begun_, u_star_);
}

void SaddleLdlt::soften_all(double share) {
  if (std::exchange(softened_, share) == share) return;
  factored_ = false;
  for (Node& node : nodes_) node.dirty = node.kind != NodeKind::kArticulated;
}

void SaddleLdlt::correct(const System& system) {
  const std::span<Block> blocks = system.blocks;
  // For impulses the speeds are those of a solution: corrections may be large.
  const bool consistent = redundant_ != Redundant::kVelocities;
  find_skipped_impulses(blocks);
  copy(u_star_, u_begun_);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::copy_n(blocks[k].bias, kMaxRows, found_[k].bias);
  }
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kMostCorrections; ++i) {
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      std::copy_n(blocks[k].impulse, kMaxRows, found_[k].impulse);
    }
    const double left = start_correction(system);
    const bool better =
        i == 0 || (left < kFalls * last &&
                   (consistent || is_near(system.u, u_earlier_, system.inverse_mass)));
    if (!better) copy(u_earlier_, system.u);
    const bool goes_on = better && i < kMostCorrections &&
                         !(left <= kAttainable * largest_of(system.u, system.inverse_mass));
    if (goes_on) {
      copy(system.u, u_earlier_);
      read(blocks);
      solve(system);
      find_skipped_impulses(blocks);
    }
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      Block& block = blocks[k];
      RowValues& found = found_[k];
      std::copy_n(found.bias, kMaxRows, block.bias);
      for (int row = 0; row < block.rows; ++row) {
        if (goes_on) {
          block.impulse[row] += found.impulse[row];
        } else {
          block.impulse[row] = better ? found.impulse[row] : found.earlier[row];
        }
        found.earlier[row] = found.impulse[row];
      }
    }
    if (!goes_on) return;
    last = left;
  }
}

}  // namespace substep
