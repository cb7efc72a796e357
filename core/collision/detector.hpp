#pragma once

#include <span>
#include <vector>

#include "core/collision/broad_phase.hpp"
#include "core/collision/shape_pairs.hpp"
#include "core/model/budget.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// As far as a body's points may go in a time, falling freely [m].
double way_in(double time, const Scene& scene, const Body& body, const Vec6& u);

/// Finds every contact point of a scene with a gap of at most the scene's margin. The order of the
/// points depends on the order of bodies in the scene only.
class Detector {
 public:
  explicit Detector(const Scene& scene);
  /// @param points that it finds at most, about (Budget::contacts)
  void set_limit(double points) { limit_ = static_cast<std::size_t>(points); }

  /// @param part only between bodies of it  @param R_WB rotation per body
  /// @return valid until the next call; not all of them where there are too_many()
  std::span<const ContactPoint> detect(const Scene& scene, const Part& part, const State& state,
                                       std::span<const Mat3> R_WB);
  /// What may come to touch within a time: the margin of a pair grows by the way that its bodies
  /// may go in it, falling freely. Boxes against boxes are only listed: where they touch changes
  /// while they come. @param ahead [s]
  std::span<const ContactPoint> predict(const Scene& scene, const Part& part, const State& state,
                                        std::span<const Mat3> R_WB, double ahead);
  /// Those boxes again, and as far ahead. @param ahead no more than what was predicted [s]
  std::span<const ContactPoint> detect_listed(const Scene& scene, const Part& part,
                                              const State& state, std::span<const Mat3> R_WB,
                                              double ahead);
  /// Per body: that its points may go in the time that the last call looked ahead [m]; or empty.
  [[nodiscard]] std::span<const double> ways() const { return way_; }
  /// How near two bodies had to be in the last call to have a point [m].
  [[nodiscard]] double margin(const Scene& scene, int i, int j) const;
  /// Pairs of the part whose boxes may meet. @param way that each body may go meanwhile [m]
  /// @return sorted by i, then j; valid until the next call
  std::span<const BroadPhase::Pair> within_reach(const Scene& scene, const Part& part,
                                                 const State& state, std::span<const Mat3> R_WB,
                                                 std::span<const double> way);
  /// Whether the last call stopped at a limit.
  [[nodiscard]] bool too_many() const { return broad_phase_.too_many() || points_.size() > limit_; }

 private:
  /// A plane, and the solids that may touch it.
  struct Ground {
    int body = 0;
    std::vector<int> solids;
  };

  using Pairs = std::vector<BroadPhase::Pair>;

  void look_ahead(const Scene& scene, const State& state, double ahead);
  /// @param boxes takes pairs of boxes within reach, unless it is null
  void find(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
            Pairs* boxes);
  void touch(const Scene& scene, const State& state, std::span<const Mat3> R_WB,
             const BroadPhase::Pair& pair);

  BroadPhase broad_phase_;
  std::size_t limit_ = static_cast<std::size_t>(Budget{}.contacts);
  std::vector<Ground> grounds_;
  std::vector<double> way_;  // per body: that its points may go meanwhile [m]; empty: none
  ContactPoints points_;
  Pairs near_;
  Pairs listed_;
};

}  // namespace substep
