#pragma once

#include <span>

#include "core/collision/detector.hpp"
#include "core/constraints/block.hpp"
#include "core/constraints/contact.hpp"

namespace substep {

/// Finds the contacts of a scene and appends a normal row for each.
class ContactStage {
 public:
  explicit ContactStage(const Scene& scene) : detector_(scene) {}
  /// @return false where there are too many: then nothing is appended
  bool detect_and_append(const Scene& scene, const Part& part, const State& state,
                         std::span<const Mat3> R_WB, Blocks& blocks);
  /// The same for what may come to touch within a time, kept for carry_and_append().
  /// Boxes of which no face lies opposite the other are not foreseen.
  /// @param ahead [s]
  bool foresee(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
               double ahead);
  /// The rows that were foreseen, where their bodies have gone since.
  void carry_and_append(const Part& part, const State& state, Blocks& blocks) const;
  /// What looks for contacts, for other questions of the same kind.
  [[nodiscard]] Detector& detector() { return detector_; }
  /// Largest overlap at a state, >= 0 [m].
  double penetration(const Scene& scene, const Part& part, const State& state,
                     std::span<const Mat3> R_WB);

 private:
  void append(std::span<const ContactPoint> points, const Scene& scene, const State& state,
              Blocks& blocks) const;

  Detector detector_;
  Blocks foreseen_;
  std::vector<Vec3> x_;  // per body: where rows were foreseen, world [m]
  std::vector<Quat> q_;
};

/// Adds two friction rows to every contact of two bodies that both have friction.
class FrictionStage {
 public:
  explicit FrictionStage(const Scene& scene);
  void append(const Scene& scene, std::span<const Mat3> R_WB, std::span<Block> blocks) const;

 private:
  std::vector<double> sqrt_mu_;  // per body: mu of a pair is the geometric mean
};

}  // namespace substep
