#pragma once

#include <cstddef>
#include <memory>

#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Solves one sub-step (Eq. 3). Scratch memory is kept, so repeated sizes do not allocate. The
/// input is blocks, bodies and Mt^-1, never J Mt^-1 J^T: each solver decides whether to form that
/// matrix, and in which order to eliminate.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Reserves memory for scenes of this size, so that the first contacts do not allocate.
  /// @param loops joints may form loops
  virtual void reserve(std::size_t bodies, std::size_t blocks, bool loops) = 0;
  /// Computes velocities and all impulses.
  SolveReport solve(const System& system, const Settings& settings) {
    SolveReport report = find_velocities(system, settings);
    if (report.status != SolveStatus::kOverLimits) report.flops += find_impulses(system.blocks);
    return report;
  }
  /// Computes velocities. Joint impulses on which no velocity depends may be left unset.
  virtual SolveReport find_velocities(const System& system, const Settings& settings) = 0;
  /// Solves the last system again, with its u* in System::u and another bias.
  /// @param keeps_bounds of friction, if the solver has any
  virtual SolveReport find_velocities_again(const System& system, const Settings& settings,
                                            bool /*keeps_bounds*/) {
    return find_velocities(system, settings);
  }
  /// Computes those impulses for the blocks of the last solved system. @return operations
  virtual std::int64_t find_impulses(std::span<Block> /*blocks*/) { return 0; }
};

inline std::unique_ptr<Solver> make_solver(SolverKind kind) { return entry_of(kind).make.call(); }

}  // namespace substep
