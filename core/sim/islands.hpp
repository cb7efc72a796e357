#pragma once

#include <span>
#include <vector>

#include "core/collision/detector.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Moving bodies that joints connect, or contacts that may come within a frame. Static bodies
/// connect nothing. Islands cannot interact within a frame, so each may take
/// sub-steps of its own.
///
/// A body may go as far in the frame as the fastest of its island, which is where an impact can
/// pass its speed on to it. What strikes harder (light bodies, thrown ahead by heavy ones, and
/// whips) is found a frame late.
class Islands {
 public:
  explicit Islands(const Scene& scene);

  /// @param all of the scene  @param ahead length of the frame [s]
  /// @param detector null where the scene has no contacts
  void find(const Scene& scene, const Part& all, const State& state, std::span<const Mat3> R_WB,
            double ahead, Detector* detector);

  [[nodiscard]] int count() const { return static_cast<int>(first_.size()) - 1; }
  /// The moving bodies of an island, ascending. Islands are numbered by their first bodies.
  [[nodiscard]] std::span<const int> bodies(int island) const;

  /// Puts islands of the same number of sub-steps into one part: what is done once a sub-step is
  /// then done once for all of them. Where the number is decided again within the frame, it is
  /// for all of a part.
  /// @param substeps of an island, from its bodies; 0 where it stands still
  template <class Substeps>
  void split(const Scene& scene, const Substeps& substeps) {
    n_.clear();
    for (int i = 0; i < count(); ++i) n_.push_back(substeps(bodies(i)));
    make_parts(scene);
  }
  /// Those of split(), of most sub-steps first; as they are until the next one.
  [[nodiscard]] std::span<const Part> parts() const { return {parts_.data(), levels_.size()}; }

 private:
  int root(int body);
  bool connect(int a, int b);  // whether they were apart
  void set_ways(const Scene& scene, const State& state, double ahead);
  void list(const Scene& scene);
  void make_parts(const Scene& scene);
  void add_part(const Scene& scene);

  std::vector<int> parent_;    // per body: towards the root of its island, which is its first body
  std::vector<double> speed_;  // per root: of the fastest point of its bodies [m/s]
  std::vector<double> way_;    // per body: that its points may go in the frame [m]
  std::vector<int> island_;    // per body, -1 of a static one
  std::vector<int> bodies_;    // island by island
  std::vector<int> first_;     // per island, into bodies_, and the end

  std::vector<int> n_;       // per island: sub-steps
  std::vector<int> levels_;  // the different ones of them, descending
  std::vector<Part> parts_;  // per level; more, to be used again
};

}  // namespace substep
