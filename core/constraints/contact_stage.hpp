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
  /// The same for what may come to touch within a time, kept for append_predicted().
  /// @param ahead [s]
  bool predict(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
               double ahead);
  /// Whether every contact of a sub-step is among those predicted; after an impact bodies may be
  /// too fast. @param dt the sub-step to come [s]
  [[nodiscard]] bool prediction_valid(const Scene& scene, const Part& part, const State& state,
                                      double dt) const;
  /// The rows that were predicted, where their bodies have gone since, as far as they may close
  /// within dt. Boxes against boxes are looked at again: a row of the edge that came first says
  /// nothing of the next one, and the box would turn about it into the other.
  /// @param dt the sub-step to come [s]  @return false where there are too many
  bool append_predicted(const Scene& scene, const Part& part, const State& state,
                        std::span<const Mat3> R_WB, double dt, Blocks& blocks);
  /// What looks for contacts, for other questions of the same kind.
  [[nodiscard]] Detector& detector() { return detector_; }

 private:
  void append(std::span<const ContactPoint> points, const Scene& scene, const State& state,
              Blocks& blocks) const;

  Detector detector_;
  Blocks predicted_;
  std::vector<Vec3> x_;  // per body: where rows were predicted, world [m]
  std::vector<Quat> q_;
  std::vector<double> way_;  // per body: that its points may go from there [m]
};

/// Largest overlap at a state, >= 0 [m].
double penetration(Detector& detector, const Scene& scene, const Part& part, const State& state,
                   std::span<const Mat3> R_WB);

/// Adds two friction rows to every contact of two bodies that both have friction.
class FrictionStage {
 public:
  explicit FrictionStage(const Scene& scene);
  void append(const Scene& scene, std::span<const Mat3> R_WB, std::span<Block> blocks) const;

 private:
  std::vector<double> sqrt_mu_;  // per body: mu of a pair is the geometric mean
};

}  // namespace substep
