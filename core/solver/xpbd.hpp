#pragma once

#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/solver/solver.hpp"

namespace substep {

/// Extended position-based dynamics of rigid bodies (Mueller et al. 2020, "Detailed rigid body
/// simulation with extended position based dynamics"): bodies first move without constraints, then
/// joints and contacts are corrected one after the other, each along its current error. Velocities
/// are derived from the displacement and represent the poses during the sweeps: (x+ - x)/dt and the
/// Cayley vector of the rotation. A fixed number of sweeps, Settings::iterations; the authors
/// recommend one, with many sub-steps.
///
/// With compliance, a correction is along the residual, error plus compliance term, rather than the
/// error alone: identical in the first sweep, and further sweeps converge to a zero residual.
/// Friction is bounded in the position correction instead of the authors' velocity pass, and
/// inertias keep their axes at the start of the sub-step.
class Xpbd final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  /// Corrects the error of some rows of a block with one impulse along it. @param bound symmetric
  /// bound on the impulse of a single row, or on the length of both friction impulses
  void correct(const System& system, std::size_t block, RowRange rows, double bound);
  /// True if a contact without impulse stays without one.
  [[nodiscard]] bool stays_open(const System& system, const Block& block) const;

  std::vector<Block> moved_;  // the blocks at the poses of their last visits
  Motions motions_;           // displacements so far
};

}  // namespace substep
