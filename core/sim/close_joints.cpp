// Joints that hold at the end of a sub-step (drift law exact).

#include <algorithm>
#include <cmath>

#include "core/constraints/contact.hpp"
#include "core/constraints/grab_rows.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/sim/simulator_impl.hpp"

namespace substep {
namespace {

constexpr int kMostClosings = 30;        // solves
constexpr int kMostSwings = 6;           // of them, with the friction bounds refreshed
constexpr double kNearRounding = 1e-12;  // of gaps, relative to the size of a joint
constexpr double kOpen = 1e-10;          // gap of a joint that is open, likewise
constexpr double kOpens = 10.0;          // growth of a gap in a sub-step that is too long

/// The size of a joint, below whose rounding its gap cannot be told from zero: its arms, and the
/// length of a distance joint, whose ends may be centres of mass [m].
double size_of(const Block& block) {
  return block.r_a.norm() + block.r_b.norm() + block.rho.norm();
}

/// The largest gap of the rows that are not springs, relative to the joint's size, or angle.
double largest_gap(const Block& block, const double* gaps) {
  const double size = size_of(block);
  double largest = 0.0;
  for (int row = 0; row < block.rows; ++row) {
    if (block.C[row] > 0.0) continue;
    const double scale = row < block.position_rows ? size : 1.0;
    largest = std::max(largest, scale > 0.0 ? std::abs(gaps[row]) / scale : 0.0);
  }
  return largest;
}

}  // namespace

bool Simulator::Impl::closes_joints(const Substep& sub) const {
  return drift_law(sub.settings) == Drift::kExact && joints && sub.integrator->knows_motion(sub);
}

// Bodies that turn together at omega move along chords: along the rows at the start of the sub-step
// they approach each other by dt/2 omega^2 times their distance, and a rigid contact row forbids
// it. Joints closed on the curved motion require it. In a loop of both, the contact's impulse would
// be this speed divided by its softness. The bias of contacts that touch therefore allows the
// approach that the curved motion makes up for.
void Simulator::Impl::let_contacts_turn(const System& system) {
  for (std::size_t i = 0; i < system.blocks.size(); ++i) {
    Block& block = system.blocks[i];
    if (!block.is_contact() || block.soft || block.phi[0] > touching(block)) continue;
    if (block.bias[0] >= kStaysOpen) continue;
    const double gained = moved_gap(block, motions.of(block.a), motions.of(block.b));
    const double opens = std::max(0.0, gained / system.dt - normal_speed(block, w));
    block.bias[0] += opens - openings[i];
    openings[i] = opens;
  }
}

// SHAKE (Ryckaert, Ciccotti and Berendsen 1977): impulses along the rows at the start of the
// sub-step, such that joints hold at its end,
//   phi(q + dt w) = 0,   u+ = u* + Mt^-1 J^T impulse,
// where w is u+, or for Störmer's method a linear function of it.
// One linear solve leaves the gap dt^2/2 phi'' in the poses; its correction in the next sub-step
// stays in the velocity, as that of a sub-step of another length if N changes. With leapfrog these
// poses are those of RATTLE (Andersen 1983) for any sequence of lengths, because the projection of
// the velocities acts along the same rows as the next impulse. This is Newton's method with the
// matrix of the first solve.
void Simulator::Impl::close_joints(const Substep& sub, const System& system, Solver& by,
                                   SolveReport& solved) {
  const auto closes = [](const Block& block) { return !block.is_bounded() && !is_grab(block); };
  double last = std::numeric_limits<double>::infinity();
  double before = 0.0;  // largest gap at the start of the sub-step
  for (const Block& block : system.blocks) {
    if (closes(block)) before = std::max(before, largest_gap(block, block.phi));
  }
  const double most = std::max(kOpen, kOpens * before);
  const bool lets_turn = contact && sweeps_motion(sub) && &by == solver.get();
  if (lets_turn) openings.assign(system.blocks.size(), 0.0);
  bool keeps_bounds = std::none_of(system.blocks.begin(), system.blocks.end(),
                                   [](const Block& b) { return b.is_contact() && b.rows == 3; });
  for (int solves = 1; solves < kMostClosings && solved.status < SolveStatus::kUnsolved; ++solves) {
    predict_motions(sub);
    double largest = 0.0;
    gaps.clear();
    for (const Block& block : system.blocks) {
      gaps.emplace_back();
      if (!closes(block)) continue;
      double gained[kMaxRows];
      moved_errors(block, motions.of(block.a), motions.of(block.b), gained);
      for (int row = 0; row < block.rows; ++row) {
        if (block.C[row] > 0.0) continue;  // a spring yields
        gaps.back().of[row] = block.phi[row] + gained[row];
      }
      largest = std::max(largest, largest_gap(block, gaps.back().of));
    }
    joints_open = !(std::min(largest, last) <= most);
    constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
    if (largest <= kRounding) return;
    // Near a singular pose it converges slowly; near rounding a small gain is noise.
    const bool closes_in = largest < (largest > kNearRounding ? 0.9 : 0.5) * last;
    const bool goes_on = closes_in || (!keeps_bounds && largest > kNearRounding);
    if (!goes_on && !(largest > last)) return;
    // In a jam the friction bounds of BPP may swing for ever; with constant ones it converges.
    keeps_bounds = keeps_bounds || !closes_in || solves >= kMostSwings;
    // A rotation too large for Newton's method opens joints further: the solve before was better.
    const double sign = goes_on ? 1.0 : -1.0;
    if (goes_on) std::swap(gaps, corrected);
    last = largest;
    for (std::size_t i = 0; i < corrected.size(); ++i) {
      Block& block = system.blocks[i];
      if (!closes(block)) continue;
      const double moved = sub.dt * sub.integrator->motion_gain(sub, state, block);
      for (int row = 0; row < block.rows; ++row) {
        block.bias[row] += sign * corrected[i].of[row] / moved;
      }
    }
    if (lets_turn) let_contacts_turn(system);
    copy(u_star, system.u);
    const SolveReport again = by.find_velocities_again(system, sub.settings, keeps_bounds);
    solved.status = std::max(solved.status, again.status);
    solved.pivots += again.pivots;
    solved.passes += again.passes;
    solved.factorisations += again.factorisations;
    solved.flops += again.flops;
    solved.memory_needed = again.memory_needed;
    solved.work_needed = again.work_needed;
    if (!goes_on) return;
  }
}

}  // namespace substep
