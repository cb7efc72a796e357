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
  /// @return false if there are too many; then nothing is appended
  bool detect_and_append(const Scene& scene, const Part& part, const State& state,
                         std::span<const Mat3> R_WB, Blocks& blocks);
  /// Only what touches. @param dt the sub-step [s]  @return as above
  bool append_touching(const Scene& scene, const Part& part, const State& state,
                       std::span<const Mat3> R_WB, double dt, Blocks& blocks);
  /// Finds contacts that may form within a time, stored for append_predicted().
  /// @param ahead [s]
  bool predict(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
               double ahead);
  /// True if the predicted contacts cover the next sub-step; after an impact bodies may be too
  /// fast. @param dt the next sub-step [s]
  [[nodiscard]] bool prediction_valid(const Scene& scene, const Part& part, const State& state,
                                      double dt) const;
  /// Appends the predicted rows, moved with their bodies, that may close within dt. Box pairs are
  /// detected again: with a row for the first edge only, the box would rotate about it into the
  /// other. @param dt the next sub-step [s]  @return false if there are too many
  bool append_predicted(const Scene& scene, const Part& part, const State& state,
                        std::span<const Mat3> R_WB, double dt, Blocks& blocks);
  [[nodiscard]] Detector& detector() { return detector_; }

 private:
  void append(std::span<const ContactPoint> points, const Scene& scene, const State& state,
              Blocks& blocks) const;

  Detector detector_;
  Blocks predicted_;
  std::vector<Vec3> x_;  // per body: position at the prediction, world [m]
  std::vector<Quat> q_;
  std::vector<double> way_;  // per body: travel of its points covered by the prediction [m]
};

/// Overlaps at a state.
struct Overlaps {
  double deepest = 0.0;  // [m]
  double inside = 0.0;   // largest overlap of a pair, of the width of the smaller body [-]
  int a = -1;            // that pair
  int b = -1;
  double squares = 0.0;  // sum over all contact points [m^2]
};
Overlaps overlaps(Detector& detector, const Scene& scene, const Part& part, const State& state,
                  std::span<const Mat3> R_WB);

/// Adds two friction rows to every contact between bodies that both have friction.
class FrictionStage {
 public:
  explicit FrictionStage(const Scene& scene);
  void append(const Scene& scene, std::span<const Mat3> R_WB, std::span<Block> blocks) const;

 private:
  std::vector<double> sqrt_mu_;  // per body: mu of a pair is the geometric mean
};

}  // namespace substep
