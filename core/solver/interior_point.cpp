#include "core/solver/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace substep {

namespace {

constexpr int kMostIterations = 40;
constexpr double kInside = 0.995;      // of the way to the nearest bound
constexpr double kRoundedMean = 1e-8;  // of the first mean product; below it rounding may show

}  // namespace

// All products of distances and speeds are equal at first: the mean over the rows of the impulse
// that stops the fastest row, times its speed.
void InteriorPoint::begin(const System& system, std::span<const Bounds> bounds, SaddleLdlt& ldlt) {
  rows_.clear();
  iterations_ = 0;
  double fastest = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    Block& block = system.blocks[i];
    if (!block.binds()) continue;
    double speed[kMaxRows];
    row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      const Bounds& of = bounds[i * kMaxRows + index(row)];
      const bool fixed = !(of.lo < of.hi) || block.bias[row] >= kStaysOpen;
      block.active_set[row] = fixed ? std::int8_t{-1} : std::int8_t{0};
      if (fixed) {
        ldlt.touch(i);
        block.impulse[row] = of.lo;
        continue;
      }
      Row& r = rows_.emplace_back();
      r.block = i;
      r.row = row;
      r.softness = block.softness[row];
      r.bias = block.bias[row];
      r.scale = mobility_of(block, row, system.inverse_mass) + r.softness;
      r.x = block.impulse[row];
      r.above = r.x - of.lo;
      r.below = of.hi - r.x;
      fastest = std::max(fastest, std::abs(speed[row] + r.bias));
      product += 1.0 / r.scale;
    }
  }
  n_bounds_ = first_ = mean_ = 0.0;
  if (!(fastest > 0.0)) return;  // no row, or all at rest: the sets are right
  product *= fastest * fastest / static_cast<double>(rows_.size());
  for (Row& r : rows_) {
    const double margin = std::min(fastest / r.scale, 0.25 * (r.above + r.below));
    const double inwards = std::max(0.0, margin - r.above) - std::max(0.0, margin - r.below);
    r.x += inwards;
    r.above = std::max(r.above + inwards, margin);
    r.below = std::max(r.below - inwards, margin);
    r.z_lo = product / r.above;
    r.z_hi = product / r.below;  // 0 without an upper bound
    n_bounds_ += r.below < kUnbounded ? 2.0 : 1.0;
  }
  first_ = mean_ = mean_product(0.0);
}

double InteriorPoint::mean_product(double part) const {
  double sum = 0.0;
  for (const Row& r : rows_) {
    sum += (r.above + part * r.dx) * (r.z_lo + part * r.dz_lo);
    if (r.below < kUnbounded) sum += (r.below - part * r.dx) * (r.z_hi + part * r.dz_hi);
  }
  return sum / n_bounds_;
}

// Newton's method for products equal to a common centre c: with D = z_lo/above + z_hi/below,
//   (A + D) (x + dx) = -q + D x + (c - bent_lo)/above - (c - bent_hi)/below.
void InteriorPoint::solve(const System& system, double centre, SaddleLdlt& ldlt) {
  for (const Row& r : rows_) {
    Block& block = system.blocks[r.block];
    const double D = r.z_lo / r.above + r.z_hi / r.below;
    const double push = (centre - r.bent_lo) / r.above - (centre - r.bent_hi) / r.below;
    block.softness[r.row] = r.softness + D;
    block.bias[r.row] = r.bias - D * r.x - push;
  }
  ldlt.read(system.blocks);
  ldlt.solve(system);
  for (Row& r : rows_) {
    r.dx = system.blocks[r.block].impulse[r.row] - r.x;
    r.dz_lo = (centre - r.bent_lo - r.z_lo * r.dx) / r.above - r.z_lo;
    r.dz_hi = (centre - r.bent_hi + r.z_hi * r.dx) / r.below - r.z_hi;
  }
}

double InteriorPoint::longest_step() const {
  double step = 1.0 / kInside;
  const auto limit = [&](double value, double change) {
    if (value + step * change < 0.0) step = -value / change;
  };
  for (const Row& r : rows_) {
    limit(r.above, r.dx);
    limit(r.below, -r.dx);
    limit(r.z_lo, r.dz_lo);
    limit(r.z_hi, r.dz_hi);
  }
  return kInside * step;
}

// The predictor aims at the bounds. How far it gets decides how much the corrector keeps away from
// them; it also includes the products of the predicted changes, with the same factor.
bool InteriorPoint::iterate(const System& system, SaddleLdlt& ldlt) {
  for (Row& r : rows_) {
    ldlt.touch(r.block);
    r.bent_lo = r.bent_hi = 0.0;
  }
  solve(system, 0.0, ldlt);
  const double left = mean_product(longest_step()) / mean_;
  for (Row& r : rows_) {
    r.bent_lo = r.dx * r.dz_lo;
    r.bent_hi = -r.dx * r.dz_hi;
  }
  solve(system, left * left * left * mean_, ldlt);
  const double step = longest_step();
  if (!std::isfinite(mean_product(step))) return false;
  for (Row& r : rows_) {
    r.x += step * r.dx;
    r.above += step * r.dx;
    r.below -= step * r.dx;
    r.z_lo += step * r.dz_lo;
    r.z_hi += step * r.dz_hi;
  }
  ++iterations_;
  return true;
}

void InteriorPoint::choose_sets(const System& system) const {
  for (const Row& r : rows_) {
    Block& block = system.blocks[r.block];
    block.softness[r.row] = r.softness;
    block.bias[r.row] = r.bias;
    block.impulse[r.row] = r.x;
    const bool at_lo = r.scale * r.above < r.z_lo;
    const bool at_hi = r.scale * r.below < r.z_hi;
    block.active_set[r.row] = at_lo ? std::int8_t{-1} : at_hi ? std::int8_t{1} : std::int8_t{0};
  }
}

void InteriorPoint::settle(const System& system, SaddleLdlt& ldlt) const {
  choose_sets(system);
  for (const Row& r : rows_) {
    system.blocks[r.block].active_set[r.row] = -1;  // a given impulse
    ldlt.touch(r.block);
  }
  ldlt.solve(system);
  choose_sets(system);
  for (const Row& r : rows_) ldlt.touch(r.block);
}

bool InteriorPoint::advance(const System& system, double end, SaddleLdlt& ldlt) {
  for (const Row& r : rows_) system.blocks[r.block].active_set[r.row] = 0;
  while (mean_ > end * first_ && iterations_ < kMostIterations) {
    const double before = mean_;
    if (!iterate(system, ldlt) || static_cast<double>(ldlt.flops()) > system.limits.work) break;
    mean_ = mean_product(0.0);
    if (mean_ < kRoundedMean * first_ && mean_ > 0.5 * before) break;
  }
  for (const Row& r : rows_) ldlt.touch(r.block);
  choose_sets(system);
  ldlt.read(system.blocks);
  return mean_ <= end * first_;
}

}  // namespace substep
