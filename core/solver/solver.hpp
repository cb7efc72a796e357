#pragma once

#include <cstddef>
#include <memory>

#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Solves one sub-step (Eq. 3). Scratch is kept inside: no allocation once sizes have been seen.
/// A solver is given blocks, bodies and Mt^-1, never J Mt^-1 J^T: whether to form that matrix, and
/// in which order to eliminate, is its own affair.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Room for scenes of this size, so that the first contacts do not allocate either.
  virtual void reserve(std::size_t bodies, std::size_t blocks) = 0;
  /// Velocities and all impulses.
  SolveReport solve(const System& system, const Settings& settings) {
    const SolveReport report = find_velocities(system, settings);
    if (report.status != SolveStatus::kOverLimits) find_impulses(system.blocks);
    return report;
  }
  /// Velocities. Impulses of joints may be left as they are where no velocity follows from them.
  virtual SolveReport find_velocities(const System& system, const Settings& settings) = 0;
  /// Those impulses, of the system that was last solved, whose blocks are given.
  virtual void find_impulses(std::span<Block> /*blocks*/) {}
};

std::unique_ptr<Solver> make_solver(SolverKind kind);

}  // namespace substep
