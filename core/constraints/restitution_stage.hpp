#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Lets bodies bounce: a contact that closes in this sub-step, faster than
/// ContactModel::restitution_speed, parts at least at e times the speed of its approach (Newton):
///   w = J u+ + bias >= 0   with   bias <= e J u-.
class RestitutionStage {
 public:
  explicit RestitutionStage(const Scene& scene);

  /// Applied to the bias that the drift law has set. A contact that was struck already in this
  /// sub-step parts at least as fast as its impacts left it.
  /// @param u_before per body: velocities before the forces of this sub-step [m/s, rad/s]
  /// @param dt the sub-step [s]
  void apply(const Scene& scene, std::span<const Vec6> u_before, double dt,
             std::span<Block> blocks) const;

  /// Whether an impact will close another contact of one of its bodies within this sub-step, which
  /// does not rebound by itself. @param u, dt as above
  bool spreads(const Scene& scene, std::span<const Vec6> u, double dt,
               std::span<const Block> blocks);

  /// Whether impacts have spread in this sub-step, and whether the contact i was among them.
  [[nodiscard]] bool struck() const { return !struck_.empty(); }
  [[nodiscard]] bool struck(std::size_t i) const { return struck() && struck_[i] != 0; }

  /// Makes the rows of all impacts that are due those of one simultaneous impact without forces:
  /// contacts that do not rebound are open, joints hold. @param u, dt as above
  /// @return whether there are any
  bool set_impacts(const Scene& scene, std::span<const Vec6> u, double dt, std::span<Block> blocks);

 private:
  [[nodiscard]] double restitution_of(const Block& contact) const;
  /// Speed of approach, where the contact rebounds from it, else 0 [m/s].
  [[nodiscard]] double impact_speed(const Scene& scene, std::span<const Vec6> u, double dt,
                                    const Block& block) const;

  std::vector<double> e_;             // per body [-]; the bouncier of two bodies counts
  std::vector<double> impact_;        // per body: the fastest of its impacts [m/s]
  std::vector<std::uint8_t> struck_;  // per block, where impacts spread in this sub-step, or empty
};

}  // namespace substep
