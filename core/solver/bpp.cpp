#include "core/solver/bpp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace substep {

namespace {

constexpr double kTolerance = 1e-11;  // on bounds and complementarity, relative
constexpr int kPasses = 4;            // refreshes of the friction bounds, the first included
constexpr int kWithoutProgress = 10;  // pivots in a row before the interior-point method
constexpr int kSinglePivots = 50;     // per solve: Murty's rule terminates; this bounds its time
constexpr int kSweeps = 100;          // sweeps of the fallback: 25 do not hold a house of cards

bool any_tight(const Block& block) {
  return std::any_of(block.active_set, block.active_set + block.rows,
                     [](std::int8_t t) { return t != 0; });
}

/// True if the block has a valid set from an earlier sub-step; it may come from a file.
bool has_known_set(const Block& block) {
  const std::int8_t set = block.active_set[0];
  if (set != 0 && set != -1 && !(set == 1 && block.is_motor()))
    return false;  // a normal has no upper bound
  return std::all_of(block.active_set + 1, block.active_set + block.rows,
                     [](std::int8_t t) { return -1 <= t && t <= 1; });
}

int refinements_of(const System& system, const Settings& settings) {
  return system.regularisation > 0.0 ? settings.refinements : 0;
}

}  // namespace

// Relative to the speeds of the bodies before and after the solve: in a stack at rest, those that
// gravity adds in a sub-step. Speeds across the row count too, because their impulses have rounding
// errors of the same size.
double Bpp::speed_tolerance(const System& system, const Block& contact, int row) const {
  double sum = std::abs(contact.bias[row]);
  const auto add = [&](int body, const double* J) {
    if (body < 0) return;
    const Eigen::Map<const Vec6> gradient(J);
    for (const Vec6& u : {ldlt_.u_star()[index(body)], system.u[index(body)]}) {
      sum += gradient.head<3>().norm() * u.head<3>().norm() +
             gradient.tail<3>().norm() * u.tail<3>().norm();
    }
  };
  add(contact.a, contact.J_a[row]);
  add(contact.b, contact.J_b[row]);
  return kTolerance * sum;
}

double Bpp::impulse_tolerance(const System& system, const Block& contact, int row) const {
  return speed_tolerance(system, contact, row) / mobility_of(contact, row, system.inverse_mass) +
         kTolerance * std::abs(contact.impulse[row]);
}

void Bpp::reserve(std::size_t bodies, std::size_t blocks, bool loops) {
  ldlt_.reserve(bodies, blocks);
  friction_bound_.reserve(blocks);
  centre_.reserve(blocks);
  unmet_.reserve(blocks);
  found_.reserve(bodies);
  if (loops) least_.reserve(bodies, blocks);
  gauss_seidel_.reserve(bodies, blocks, loops);
  interior_point_.reserve(blocks);
  bounds_.reserve(blocks * kMaxRows);
}

void Bpp::find_active_set(const System& system, const Settings& settings, int passes,
                          SolveReport& report) {
  report.status = SolveStatus::kSolved;
  if (!any_bounded_) {
    ldlt_.solve(system);
    over_limits(system, report);
    return;
  }
  int single_pivots = kSinglePivots;
  for (int pass = 0; pass < passes; ++pass) {
    ++report.passes;
    set_friction_bounds(system);
    if (settings.friction_cone == FrictionCone::kCone) soften_sliding(system);
    bool approached = false;
    if (!find_within_bounds(system, settings, single_pivots, approached, report)) return;
    if (approached) passes = std::min(passes, pass + 2);  // it costs as much as all others
    if (bounds_settled(system)) return;
  }
  report.status = SolveStatus::kUnsettled;
}

bool Bpp::find_within_bounds(const System& system, const Settings& settings, int& single_pivots,
                             bool& approached, SolveReport& report) {
  const int without_progress = system.contacts_yield ? kWithoutProgress : settings.pivots;
  if (pivot_blocks(system, settings.pivots, without_progress, report)) return true;
  if (report.status == SolveStatus::kOverLimits) return false;
  approached = system.contacts_yield;
  if (approached ? approach(system, report) : pivot_singly(system, single_pivots, report)) {
    return true;
  }
  if (report.status != SolveStatus::kOverLimits) go_on_with_gauss_seidel(system, settings, report);
  return false;
}

// Infeasible rows may become more, and sets may come again. The limit on pivots that do not reduce
// the fewest infeasible rows is that of Júdice and Pires (1994).
bool Bpp::pivot_blocks(const System& system, int most, int without_progress, SolveReport& report) {
  int fewest = std::numeric_limits<int>::max();
  int since = 0;
  for (int i = 0; i < most && since < without_progress; ++i) {
    solve_active_set(system);
    if (over_limits(system, report)) return false;
    const int infeasible = pivot(system, false);
    if (infeasible == 0) return true;
    ++report.pivots;
    since = infeasible < fewest ? 0 : since + 1;
    fewest = std::min(fewest, infeasible);
  }
  return false;
}

bool Bpp::pivot_singly(const System& system, int& left, SolveReport& report) {
  for (;;) {
    solve_active_set(system);
    if (over_limits(system, report)) return false;
    if (pivot(system, true) == 0) return true;
    ++report.pivots;
    if (--left < 0) return false;
  }
}

// Near the minimum the sets are mostly right, and a few pivots make the solution exact. Rows that
// hardly push and hardly separate may keep them from it; then the point that was reached is taken.
bool Bpp::approach(const System& system, SolveReport& report) {
  constexpr int kPivots = 3;
  constexpr double kClose = 1e-11;  // relative products of impulses and speeds
  constexpr double kClosest = 1e-13;
  bounds_.resize(system.blocks.size() * kMaxRows);
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    const Block& block = system.blocks[i];
    for (int row = 0; row < block.rows; ++row) {
      bounds_[i * kMaxRows + index(row)] =
          row == 0 ? Bounds{block.lo, block.hi} : Bounds{-friction_bound_[i], friction_bound_[i]};
    }
  }
  copy(ldlt_.u_star(), system.u);
  interior_point_.begin(system, bounds_, ldlt_);
  for (const double end : {kClose, kClosest}) {
    const bool is_close = interior_point_.advance(system, end, ldlt_) || end < kClose;
    if (over_limits(system, report)) return false;
    if (pivot_blocks(system, kPivots, kPivots, report)) return true;
    if (!is_close || report.status == SolveStatus::kOverLimits) return false;
  }
  interior_point_.settle(system, ldlt_);
  return !over_limits(system, report);
}

// The centre's share of w moves into the bias: r (x - x0) + bias = r x + (bias - r x0).
void Bpp::centre(const System& system) {
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    Block& block = system.blocks[i];
    for (int row = 0; row < block.rows; ++row) {
      double& at = centre_[i].row[row];
      block.bias[row] -= system.regularisation * (block.impulse[row] - at);
      at = block.impulse[row];
    }
  }
  ldlt_.read(system.blocks);
}

void Bpp::solve_redundant(const System& system) {
  ldlt_.refine(system);
  unmet_.resize(system.blocks.size());
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    const Block& block = system.blocks[i];
    double w[kMaxRows];
    row_speeds(block, system.u, w);
    for (int row = 0; row < block.rows; ++row) {
      unmet_[i].row[row] = w[row] + block.softness[row] * block.impulse[row] + block.bias[row];
    }
  }
}

void Bpp::keep_redundant(const System& system) {
  redundant_ = {};
  if (!ldlt_.held()) return;
  found_.resize(system.u.size());
  copy(system.u, found_);
  redundant_ = system;
  redundant_.u = found_;
}

SolveReport Bpp::find_velocities(const System& system, const Settings& settings) {
  if (settings.friction_cone == FrictionCone::kCone) align_tangents(system);
  if (refinements_of(system, settings) > 0) centre_.assign(system.blocks.size(), RowValues{});
  return find_again(system, settings);
}

SolveReport Bpp::find_again(const System& system, const Settings& settings) {
  if (!ldlt_.begin(system)) {
    return {.status = SolveStatus::kOverLimits, .memory_needed = ldlt_.needed_memory()};
  }
  SolveReport report;
  has_impulses_ = false;
  redundant_ = {};
  any_bounded_ = false;
  for (Block& block : system.blocks) {
    if (!block.is_bounded()) continue;
    if (block.binds()) {
      any_bounded_ = true;
    } else {
      block.active_set[0] = 0;
    }
  }
  if (any_bounded_) start_active_set(system);
  const int refinements = refinements_of(system, settings);
  if (refinements > 0) centre(system);
  find_active_set(system, settings, kPasses, report);
  for (int i = 0; i < refinements && report.status < SolveStatus::kUnsolved; ++i) {
    find_impulses(system.blocks);
    centre(system);
    find_active_set(system, settings, kPasses, report);
  }
  if (report.status == SolveStatus::kOverLimits) return report;
  if (!any_bounded_ && ldlt_.held()) solve_redundant(system);
  keep_redundant(system);
  report.factorisations = ldlt_.factorisations();
  report.flops += ldlt_.flops();
  return report;
}

SolveReport Bpp::find_velocities_again(const System& system, const Settings& settings,
                                       bool keeps_bounds) {
  const bool bounds_move = any_bounded_ && (!system.contacts_yield || has_impulses_);
  if (bounds_move || settings.refinements > 0) return find_again(system, settings);
  SolveReport report;
  const std::int64_t flops = ldlt_.flops();
  const int factorisations = ldlt_.factorisations();
  if (!any_bounded_ && ldlt_.held()) {
    // A part of what redundant rows demand no impulse can meet. A bias that is added to would
    // collect these parts, and the rows pull at each other.
    for (std::size_t i = 0; i < system.blocks.size(); ++i) {
      Block& block = system.blocks[i];
      for (int row = 0; row < block.rows; ++row) block.bias[row] -= unmet_[i].row[row];
    }
    solve_redundant(system);
  } else {
    ldlt_.read(system.blocks);
    if (any_bounded_ && keeps_bounds) {
      int single_pivots = 0;
      bool approached = false;
      find_within_bounds(system, settings, single_pivots, approached, report);
    } else {
      find_active_set(system, settings, 1, report);
    }
  }
  keep_redundant(system);
  report.factorisations = ldlt_.factorisations() - factorisations;
  report.flops += ldlt_.flops() - flops;
  return report;
}

// With the w of System, linear in the impulses z, the solution is where
//   1/2 z (w(z) + w(0))   [J]
// is minimal within the bounds; it is 0 at z = 0. A badly wrong active set increases it by orders
// of magnitude.
bool Bpp::better_than_none(const System& system) const {
  double energy = 0.0;
  double speed[kMaxRows];
  for (const Block& block : system.blocks) {
    row_speeds(block, ldlt_.u_star(), speed);
    for (int row = 0; row < block.rows; ++row) {
      energy += 0.5 * block.impulse[row] * (speed[row] + block.bias[row]);
    }
    apply_impulse(block, block.impulse, system.inverse_mass, system.u);
  }
  for (const Block& block : system.blocks) {
    row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      const double w = speed[row] + block.softness[row] * block.impulse[row] + block.bias[row];
      energy += 0.5 * block.impulse[row] * w;
    }
  }
  return energy < 0.0;
}

std::int64_t Bpp::find_impulses(std::span<Block> blocks) {
  if (has_impulses_) return 0;
  const std::int64_t before = ldlt_.flops();
  ldlt_.find_impulses(blocks);
  std::int64_t flops = ldlt_.flops() - before;
  if (!redundant_.blocks.empty()) {
    redundant_.blocks = blocks;
    flops += least_.find(redundant_, ldlt_.u_star());
  }
  return flops;
}

bool Bpp::over_limits(const System& system, SolveReport& report) const {
  const double work = static_cast<double>(report.flops + ldlt_.flops());
  if (work <= system.limits.work) return false;
  report.status = SolveStatus::kOverLimits;
  report.work_needed = work;
  return true;
}

void Bpp::go_on_with_gauss_seidel(const System& system, const Settings& settings,
                                  SolveReport& report) {
  report.status = SolveStatus::kUnsolved;
  find_impulses(system.blocks);
  has_impulses_ = true;
  for (Block& block : system.blocks) {
    if (!block.is_bounded()) continue;
    if (block.rows == 3 && block.sliding > 0.0) {  // it has a cone of its own
      block.softness[2] = block.softness[1];
      block.bias[2] -= std::exchange(block.across, 0.0);
      block.sliding = 0.0;
    }
    block.impulse[0] = std::min(block.hi, std::max(block.lo, block.impulse[0]));
    const double bound = block.mu * block.impulse[0];
    for (int row = 1; row < block.rows; ++row) {
      block.impulse[row] = std::min(bound, std::max(-bound, block.impulse[row]));
    }
  }
  const auto restore = [&] { copy(ldlt_.u_star(), system.u); };
  restore();
  Settings sweeps = settings;
  sweeps.iterations = std::max(settings.iterations, kSweeps);
  sweeps.warm_start = better_than_none(system);
  restore();
  const SolveReport swept = gauss_seidel_.solve(system, sweeps);
  report.flops += swept.flops;
  if (swept.status == SolveStatus::kOverLimits) {
    report.status = swept.status;
    report.work_needed = swept.work_needed;
  }
  for (Block& block : system.blocks) {
    if (!block.is_bounded()) continue;
    block.active_set[0] = !(block.impulse[0] > block.lo)   ? std::int8_t{-1}
                          : !(block.impulse[0] < block.hi) ? std::int8_t{1}
                                                           : std::int8_t{0};
    for (int row = 1; row < block.rows; ++row) {
      const double bound = friction_bound(block, row, block.impulse[0]);
      block.active_set[row] = block.impulse[row] >= bound    ? std::int8_t{1}
                              : block.impulse[row] <= -bound ? std::int8_t{-1}
                                                             : std::int8_t{0};
    }
  }
}

// A row active in the last sub-step starts active. A new contact starts free if the bodies would
// touch within the step.
void Bpp::start_active_set(const System& system) {
  friction_bound_.assign(system.blocks.size(), 0.0);
  for (Block& block : system.blocks) {
    if (!block.binds()) continue;  // always free
    if (block.lo == block.hi) {
      block.active_set[0] = -1;
    } else if (block.is_motor() && !has_known_set(block)) {
      block.active_set[0] = 0;
    } else if (!has_known_set(block)) {
      double speed[kMaxRows];
      row_speeds(block, system.u, speed);
      const bool reaches = speed[0] + block.bias[0] < 0.0;
      std::fill(block.active_set, block.active_set + block.rows,
                static_cast<std::int8_t>(reaches ? 0 : -1));
    }
  }
}

void Bpp::set_friction_bounds(const System& system) {
  const std::span<Block> blocks = system.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Block& block = blocks[i];
    if (block.rows != 3 || !block.is_contact()) continue;
    friction_bound_[i] = block.mu * std::max(0.0, block.impulse[0]);
    for (int row = 1; row < 3; ++row) {  // zero bound: never free
      if (friction_bound_[i] > 0.0 || block.active_set[row] != 0) continue;
      block.active_set[row] = -1;
      ldlt_.touch(i);
    }
  }
}

void Bpp::soften_sliding(const System& system) {
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    Block& block = system.blocks[i];
    if (block.rows != 3 || !block.is_contact()) continue;
    if (soften_across(block) && block.active_set[2] == 0) ldlt_.touch(i);
  }
}

bool Bpp::bounds_settled(const System& system) const {
  const std::span<const Block> blocks = system.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    if (block.rows != 3 || !block.is_contact()) continue;
    const double bound = block.mu * std::max(0.0, block.impulse[0]);
    for (int row = 1; row < 3; ++row) {
      const double beyond = block.active_set[row] == 0 ? std::abs(block.impulse[row]) - bound
                                                       : std::abs(bound - friction_bound_[i]);
      if (beyond > 0.0 && beyond > impulse_tolerance(system, block, row)) return false;
    }
  }
  return true;
}

void Bpp::solve_active_set(const System& system) {
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    Block& block = system.blocks[i];
    if (!block.is_bounded()) continue;
    for (int row = 0; row < block.rows; ++row) {
      const std::int8_t set = block.active_set[row];
      if (set == 0) continue;
      block.impulse[row] = row > 0 ? set * friction_bound_[i] : set < 0 ? block.lo : block.hi;
    }
  }
  ldlt_.solve(system);
}

void Bpp::move(std::span<Block> blocks, const Move& move) {
  std::int8_t& set = blocks[move.block].active_set[move.row];
  // A move from one bound to the other does not change the free rows.
  if (set == 0 || move.set == 0) ldlt_.touch(move.block);
  set = move.set;
}

int Bpp::pivot(const System& system, bool one_only) {
  int wrong = 0;
  Move last;
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    Block& block = system.blocks[i];
    if (!block.is_bounded()) continue;
    double speed[kMaxRows];
    if (any_tight(block)) row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      const double hi = row == 0 ? block.hi : friction_bound_[i];
      const double lo = row == 0 ? block.lo : -hi;
      if (hi == lo) continue;
      const double x = block.impulse[row];
      std::int8_t set = block.active_set[row];
      if (set == 0 && lo <= x && x <= hi) continue;
      if (set == 0) {
        const double beyond = std::max(lo - x, x - hi);
        if (beyond > impulse_tolerance(system, block, row)) set = x < lo ? -1 : 1;
      } else {
        const double w = speed[row] + block.softness[row] * x + block.bias[row];
        const double wrong_way = set < 0 ? -w : w;
        if (wrong_way > 0.0 && wrong_way > speed_tolerance(system, block, row)) set = 0;
      }
      if (set == block.active_set[row]) continue;
      ++wrong;
      if (one_only) {
        last = {i, row, set};
      } else {
        move(system.blocks, {i, row, set});
      }
    }
  }
  if (one_only && wrong > 0) move(system.blocks, last);
  return wrong;
}

std::unique_ptr<Solver> make_bpp() { return std::make_unique<Bpp>(); }

}  // namespace substep
