#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Lets bodies bounce: a contact that closes in this sub-step, faster than
/// ContactModel::restitution_speed, parts at least at e times the speed of its approach (Newton):
///   w = J u+ + bias >= 0   with   bias <= e J u-.
/// Applied to the bias that the drift law has set.
class RestitutionStage {
 public:
  explicit RestitutionStage(const Scene& scene);

  /// @param u_before per body: velocities before the forces of this sub-step [m/s, rad/s]
  /// @param dt the sub-step [s]
  void apply(const Scene& scene, std::span<const Vec6> u_before, double dt,
             std::span<Block> blocks) const;

 private:
  std::vector<double> e_;  // per body [-]; the bouncier of two bodies counts
};

}  // namespace substep
