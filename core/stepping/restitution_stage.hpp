#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/scene.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

/// Restitution: a contact that closes in this sub-step faster than ContactModel::restitution_speed
/// separates at no less than e times its approach speed (Newton):
///   w = J u+ + bias >= 0   with   bias <= e J u-.
/// With contacts found along the motion, u- is the velocity where and when the contact closes,
/// forces until then included, and those after it act on the rebound: heights are right at any N.
class RestitutionStage {
 public:
  /// Impacts that are closer in time are one, of the sub-step.
  static constexpr double kSimultaneous = 1e-3;

  explicit RestitutionStage(const Scene& scene) : scene_(scene), impact_(scene.bodies.size()) {}
  /// Reserves memory, so that an impact does not allocate.
  void reserve(std::size_t blocks) {
    hits_.reserve(blocks);
    struck_.reserve(blocks);
  }

  /// The coefficient e of a contact: the larger one of its bodies.
  [[nodiscard]] double restitution_of(const Block& contact) const;

  /// Modifies the bias set by the drift law. With contacts found along the motion, all rebounds are
  /// impacts that spread. A contact already struck in this sub-step separates at
  /// least as fast as after its impacts.
  /// @param u_before per body: velocities before the forces of this sub-step [m/s, rad/s]
  void apply(const Substep& sub, std::span<const Vec6> u_before, std::span<Block> blocks) const;

  /// True if an impact closes another contact of one of its bodies within this sub-step that does
  /// not rebound itself, or if there is any impact and contacts are found along the motion.
  bool spreads(const Substep& sub, std::span<const Vec6> u, std::span<const Block> blocks);

  /// Per block: 1 if an impact of this sub-step was propagated there. Empty if none was propagated.
  [[nodiscard]] std::span<const std::uint8_t> struck() const { return struck_; }

  /// Sets up the rows of the first pending impacts, or of all if their times are not known, as one
  /// simultaneous impact without forces: contacts that do not rebound are open, joints are rigid.
  /// @param u as above  @param share of e, in [0, 1]  @return true if there are any
  bool set_impacts(const Substep& sub, std::span<const Vec6> u, double share,
                   std::span<Block> blocks);
  /// How long the forces have acted on u when a block closes [s]; 0 if it does not rebound.
  [[nodiscard]] double force_time(std::size_t block) const { return hits_[block].force_time; }
  /// The part of the velocity change by these impacts that does not move the bodies in this
  /// sub-step: the first of them closes after this part of it, or those before. Second order.
  [[nodiscard]] double late() const { return late_; }

 private:
  struct Impact {
    double speed = 0.0;         // approach when the contact closes, 0 if it does not rebound [m/s]
    double force_time = 0.0;    // of forces until then [s]
    double kick = 0.0;          // change of the normal speed by them [m/s]
    double time = 0.0;          // when it closes, if known [s]
    double acceleration = 0.0;  // along the normal, by forces [m/s^2]
  };
  [[nodiscard]] Impact impact(const Substep& sub, std::span<const Vec6> u,
                              const Block& block) const;

  const Scene& scene_;
  std::vector<Impact> hits_;          // per block: of the last set_impacts()
  std::vector<double> impact_;        // per body: fastest impact [m/s]
  std::vector<std::uint8_t> struck_;  // per block, if impacts were propagated; else empty
  double since_ = 0.0;                // part of the sub-step after which the last impacts close
  double late_ = 0.0;
};

}  // namespace substep
