#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/collision/broad_phase.hpp"
#include "core/collision/shape_pairs.hpp"
#include "core/model/budget.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Bound on the travel of a body's points in a time, in free fall [m].
double way_in(double time, const Scene& scene, const Body& body, const Vec6& u);

/// Finds every contact point of a scene with a gap of at most the scene's margin. The order of the
/// points depends only on the order of bodies in the scene.
class Detector {
 public:
  explicit Detector(const Scene& scene);
  /// @param points approximate limit on their number (Budget::contacts)
  void set_limit(double points) { limit_ = static_cast<std::size_t>(points); }

  /// @param part only contacts between its bodies are found  @param R_WB rotation per body
  /// @return valid until the next call; incomplete if too_many()
  std::span<const ContactPoint> detect(const Scene& scene, const Part& part, const State& state,
                                       std::span<const Mat3> R_WB);
  /// Contacts that may form within a time: the margin of a pair grows by the free-fall travel
  /// bounds of its bodies. Box pairs are only listed, because their contact points change as they
  /// approach. @param ahead [s]
  std::span<const ContactPoint> predict(const Scene& scene, const Part& part, const State& state,
                                        std::span<const Mat3> R_WB, double ahead);
  /// Contacts of the listed box pairs that may form within a time. @param ahead at most that of
  /// predict() [s]
  std::span<const ContactPoint> detect_listed(const Scene& scene, const Part& part,
                                              const State& state, std::span<const Mat3> R_WB,
                                              double ahead);
  /// Contacts with a gap that is small beside the narrower shape. @param dt the sub-step [s]
  std::span<const ContactPoint> detect_touching(const Scene& scene, const Part& part,
                                                const State& state, std::span<const Mat3> R_WB,
                                                double dt);
  /// Pairs that may meet within a sub-step; the second may be a plane. @param w per body:
  /// velocities of the motion [m/s, rad/s]  @return valid until the next call
  std::span<const BroadPhase::Pair> may_meet(const Scene& scene, const Part& part,
                                             const State& state, std::span<const Mat3> R_WB,
                                             std::span<const Vec6> w, double dt);
  /// Half width of the narrower of two shapes [m].
  [[nodiscard]] double half_width(int i, int j) const {
    return std::min(half_width_[index(i)], half_width_[index(j)]);
  }
  /// Per body: travel bound of its points in the look-ahead of the last call [m]; or empty.
  [[nodiscard]] std::span<const double> ways() const { return way_; }
  /// Contact margin of two bodies in the last call [m].
  [[nodiscard]] double margin(const Scene& scene, int i, int j) const;
  /// Pairs of the part whose boxes may meet. @param way travel bound per body [m]
  /// @return sorted by i, then j; valid until the next call
  std::span<const BroadPhase::Pair> within_reach(const Scene& scene, const Part& part,
                                                 const State& state, std::span<const Mat3> R_WB,
                                                 std::span<const double> way);
  /// Solids and pairs looked at since the last call.
  std::int64_t take_visits() { return broad_phase_.take_visits() + std::exchange(visits_, 0); }
  /// True if the last call stopped at a limit.
  [[nodiscard]] bool too_many() const { return broad_phase_.too_many() || points_.size() > limit_; }

 private:
  /// A plane, and the solids that may touch it.
  struct Ground {
    int body = 0;
    std::vector<int> solids;
  };

  using Pairs = std::vector<BroadPhase::Pair>;

  void find_ways(const Scene& scene, std::span<const Vec6> w, double dt);
  void look_ahead(const Scene& scene, const State& state, double ahead);
  /// @param boxes out: pairs of boxes within reach, unless null
  void find(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
            Pairs* boxes);
  void touch(const Scene& scene, const State& state, std::span<const Mat3> R_WB,
             const BroadPhase::Pair& pair);

  BroadPhase broad_phase_;
  std::size_t limit_ = static_cast<std::size_t>(Budget{}.contacts);
  std::vector<Ground> grounds_;
  std::vector<double> way_;         // per body: travel bound of its points [m]; empty: zero
  std::vector<double> half_width_;  // per body [m]; of a plane infinite
  bool touching_ = false;           // only what touches is looked for
  ContactPoints points_;
  Pairs near_;
  Pairs listed_;
  std::int64_t visits_ = 0;
};

}  // namespace substep
