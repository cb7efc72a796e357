#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Restitution: a contact that closes in this sub-step faster than ContactModel::restitution_speed
/// separates at no less than e times its approach speed (Newton):
///   w = J u+ + bias >= 0   with   bias <= e J u-.
class RestitutionStage {
 public:
  explicit RestitutionStage(const Scene& scene) : scene_(scene), impact_(scene.bodies.size()) {}

  /// Modifies the bias set by the drift law. A contact already struck in this sub-step separates at
  /// least as fast as after its impacts.
  /// @param u_before per body: velocities before the forces of this sub-step [m/s, rad/s]
  /// @param dt the sub-step [s]
  void apply(std::span<const Vec6> u_before, double dt, std::span<Block> blocks) const;

  /// True if an impact closes another contact of one of its bodies within this sub-step that does
  /// not rebound itself. @param u, dt as above
  bool spreads(std::span<const Vec6> u, double dt, std::span<const Block> blocks);

  /// Per block: 1 if an impact of this sub-step was propagated there. Empty if none was propagated.
  [[nodiscard]] std::span<const std::uint8_t> struck() const { return struck_; }

  /// Sets up the rows of all pending impacts as one simultaneous impact without forces: contacts
  /// that do not rebound are open, joints are rigid. @param u, dt as above  @return true if there
  /// are any
  bool set_impacts(std::span<const Vec6> u, double dt, std::span<Block> blocks);

 private:
  /// Of a pair: the maximum.
  [[nodiscard]] double restitution_of(const Block& contact) const;
  /// Approach speed if the contact rebounds, else 0 [m/s].
  [[nodiscard]] double impact_speed(std::span<const Vec6> u, double dt, const Block& block) const;

  const Scene& scene_;
  std::vector<double> impact_;        // per body: fastest impact [m/s]
  std::vector<std::uint8_t> struck_;  // per block, if impacts were propagated; else empty
};

}  // namespace substep
