#pragma once

#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/solver/solver.hpp"

namespace substep {

/// Extended position-based dynamics of rigid bodies (Mueller et al. 2020, "Detailed rigid body
/// simulation with extended position based dynamics"): bodies are first moved as if nothing held
/// them, then the joints and contacts of that pose are set right one after the other, each along
/// its error as it is at that moment. The velocities are those of the way gone, and stand for the
/// poses on the way: (x+ - x)/dt and the Cayley vector of the turn. A fixed number of sweeps,
/// Settings::iterations; the source recommends one, and many sub-steps.
///
/// With compliance a correction goes along what is left of the rows, error and compliance part
/// together, in the place of the error alone: the same in the first sweep, and further ones end
/// where nothing is left. Friction is bounded where positions are corrected, in the place of the
/// source's velocity pass, and the bodies' inertia keeps the axes of the start of the sub-step.
class Xpbd final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  /// Sets the error of some rows of a block right, with one impulse along it.
  /// @param bound on the impulse of a single row, symmetric, or on the length of both rows' of
  /// friction; unbounded else
  void correct(const System& system, std::size_t block, RowRange rows, double bound = kUnbounded);
  /// Whether a contact that carries nothing would not carry anything now either.
  [[nodiscard]] bool stays_open(const System& system, const Block& block) const;
  [[nodiscard]] const Motion& motion_of(int body) const;

  std::vector<Block> moved_;     // the blocks at the poses of their last visits
  std::vector<Motion> motions_;  // per body: of the way so far, and of what stands still at the end
};

}  // namespace substep
