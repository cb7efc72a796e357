#pragma once

#include <span>
#include <vector>

#include "core/collision/detector.hpp"
#include "core/math/disjoint_sets.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Groups of moving bodies connected by joints, or by contacts that may form within a frame. Static
/// bodies connect nothing. Islands cannot interact within a frame, so each may have its own
/// sub-steps.
///
/// The travel bound of a body is that of the fastest body in its island, since impacts can transfer
/// that speed. Faster motion (light bodies struck by heavy ones, whips) is detected one frame late.
class Islands {
 public:
  explicit Islands(const Scene& scene);

  /// @param all part with the whole scene  @param ahead length of the frame [s]
  /// @param detector null if the scene has no contacts
  void find(const Scene& scene, const Part& all, const State& state, std::span<const Mat3> R_WB,
            double ahead, Detector* detector);

  [[nodiscard]] int count() const { return static_cast<int>(first_.size()) - 1; }
  /// The moving bodies of an island, ascending. Islands are ordered by their first bodies.
  [[nodiscard]] std::span<const int> bodies(int island) const;

  /// Merges islands with equal numbers of sub-steps into one part, to share the fixed cost of a
  /// sub-step. If N is re-evaluated within the frame, it applies to the whole part.
  /// @param substeps number for an island, given its bodies; 0 for an island at rest
  template <class Substeps>
  void split(const Scene& scene, const Substeps& substeps) {
    n_.clear();
    for (int i = 0; i < count(); ++i) n_.push_back(substeps(bodies(i)));
    make_parts(scene);
  }
  /// Parts made by split(), most sub-steps first; valid until the next split().
  [[nodiscard]] std::span<const Part> parts() const { return {parts_.data(), levels_.size()}; }

 private:
  void set_ways(const Scene& scene, const State& state, double ahead);
  void list(const Scene& scene);
  void make_parts(const Scene& scene);
  void add_part(const Scene& scene);

  DisjointSets connected_;     // bodies; a root is the first body of its island
  std::vector<double> speed_;  // per root: bound on the speed of its bodies' points [m/s]
  std::vector<double> way_;    // per body: bound on the travel of its points in the frame [m]
  std::vector<int> island_;    // per body, -1 if static
  std::vector<int> bodies_;    // island by island
  std::vector<int> first_;     // per island: offset into bodies_; then the end

  std::vector<int> n_;       // per island: sub-steps
  std::vector<int> levels_;  // distinct values of n_, descending
  std::vector<Part> parts_;  // one per level; surplus entries are kept for reuse
};

}  // namespace substep
