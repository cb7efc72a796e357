#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/disjoint_sets.hpp"
#include "core/solver/saddle_ldlt.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// The impulses of least norm among those that change the velocities in the same way.
///
/// Redundant rows have no unique impulses. From zero impulses, the proximal-point iteration of
/// SaddleLdlt::refine() converges to those of least norm among the solutions (Rockafellar 1976), a
/// smooth function of the pose. The weights are the mobilities of the joints, the same for all rows
/// of a joint of one unit, so that units and axes do not matter, nor, if all rows share, the order
/// of bodies and joints.
class LeastImpulses {
 public:
  explicit LeastImpulses(SaddleLdlt::Redundant redundant) : ldlt_(redundant) {}
  void reserve(std::size_t bodies, std::size_t blocks);
  /// Replaces the impulses of rows without bounds if exact joints form a loop; those of rows with
  /// bounds, such as contacts and motors, are kept. @param system solved: with u+ and impulses
  /// @return floating-point operations
  std::int64_t find(const System& system, std::span<const Vec6> u_star);

 private:
  [[nodiscard]] bool has_loop(std::span<const Block> blocks,
                              std::span<const InverseMass> inverse_mass);

  SaddleLdlt ldlt_;
  Blocks rows_;          // those without bounds
  std::vector<Vec6> u_;  // per body: change of the velocity [m/s, rad/s]
  DisjointSets joined_;  // bodies, and as the last number the world
};

}  // namespace substep
