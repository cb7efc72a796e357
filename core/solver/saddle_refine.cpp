// Iterative refinement, where pivots were held.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/flops.hpp"
#include "core/solver/saddle_ldlt.hpp"

namespace substep {

namespace {

constexpr int kMost = 3;             // corrections
constexpr double kFalls = 0.5;       // what |w| falls to, or the correction before was none
constexpr double kChange = 1e-2;     // most that a correction changes of the velocities
constexpr double kRounding = 1e-15;  // of the velocities: all that can be asked for

double largest_of(std::span<const Vec6> u) {
  double largest = 0.0;
  for (const Vec6& of_body : u) largest = std::max(largest, of_body.cwiseAbs().maxCoeff());
  return largest;
}

/// Whether two sets of velocities differ by little. False where one is no number.
bool is_near(std::span<const Vec6> u, std::span<const Vec6> v) {
  const double most = kChange * largest_of(v);
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (!((u[i] - v[i]).cwiseAbs().maxCoeff() <= most)) return false;
  }
  return true;
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
    for (int row = 0; row < block.rows; ++row) {
      block.bias[row] += block.softness[row] * block.impulse[row];
      largest = std::max(largest, std::abs(w[row] + block.bias[row]));
      block.impulse[row] = 0.0;
    }
    const int sides = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
    flops_ += 2 * product_flops(block.rows, 6, sides) + 5 * block.rows;
  }
  return largest;
}

// A held pivot makes its row a spring, w = J u+ + s x + bias = -e x with e of 1e-8 of J Mt^-1 J^T,
// and what it is divided by costs the later bodies as many digits. The impulses found are a start,
// though: with x = x0 + d and u0 = u* + Mt^-1 J^T x0, the d that is left to be found is that of
//   J (u0 + Mt^-1 J^T d) + s d + (bias + s x0) = 0,
// a solve with the factor at hand. What it is wrong by falls by e over what the whole system sees
// of the row. Where rows contradict each other it does not fall, or what they nearly agree on would
// be thrown about: then the bodies go where the held pivots let them, and nothing is corrected.
void SaddleLdlt::refine(const System& system) {
  const std::span<Block> blocks = system.blocks;
  find_impulses(blocks);
  u_begun_.resize(u_star_.size());
  u_earlier_.resize(u_star_.size());
  copy(u_star_, u_begun_);
  found_.resize(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::copy_n(blocks[k].bias, kMaxRows, found_[k].bias);
  }
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kMost; ++i) {
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      std::copy_n(blocks[k].impulse, kMaxRows, found_[k].impulse);
    }
    const double left = start_correction(system);
    const bool better = i == 0 || (left < kFalls * last && is_near(system.u, u_earlier_));
    if (!better) copy(u_earlier_, system.u);
    const bool goes_on = better && i < kMost && !(left <= kRounding * largest_of(system.u));
    if (goes_on) {
      copy(system.u, u_earlier_);
      read(blocks);
      solve(system);
      find_impulses(blocks);
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
