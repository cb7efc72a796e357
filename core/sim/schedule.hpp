#pragma once

#include <algorithm>
#include <vector>

#include "core/model/part.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {

/// The sub-steps of a frame: the parts of the scene in turn, each with its own clock.
class Schedule {
 public:
  Schedule() { turns_.reserve(16); }
  void clear() {
    turns_.clear();
    at_ = 0;
  }
  /// @param part must outlive the frame
  void add(const Part& part, const SubstepClock& clock) { turns_.push_back({&part, clock}); }

  [[nodiscard]] bool running() const { return at_ < turns_.size(); }
  // Properties of the next sub-step; valid while running().
  [[nodiscard]] const Part& part() const { return *turns_[at_].part; }
  [[nodiscard]] const SubstepClock& clock() const { return turns_[at_].clock; }
  /// Ends the sub-step after dt. @param dt [s]
  void shorten(double dt) { turns_[at_].clock.shorten(dt); }
  /// Advances to the next sub-step. @param r, r_rotation of the current one, if needed [1/s^2]
  void advance(double r, double r_rotation) {
    SubstepClock& clock = turns_[at_].clock;
    clock.advance(r, r_rotation);
    if (!clock.running()) ++at_;
  }

  /// Remaining sub-steps of the frame, as currently planned.
  [[nodiscard]] int left() const {
    int sum = 0;
    for (std::size_t i = at_; i < turns_.size(); ++i) sum += turns_[i].clock.left();
    return sum;
  }
  // Over all parts.
  [[nodiscard]] bool moves(int body) const {
    return std::any_of(turns_.begin(), turns_.end(),
                       [&](const Turn& turn) { return turn.part->holds(body); });
  }
  /// The largest [1/s^2].
  [[nodiscard]] double r() const {
    double most = 0.0;
    for (const Turn& turn : turns_) most = std::max(most, turn.clock.r());
    return most;
  }
  [[nodiscard]] int n_wanted() const {
    int most = 1;
    for (const Turn& turn : turns_) most = std::max(most, turn.clock.n_wanted());
    return most;
  }
  [[nodiscard]] bool capped() const {
    return std::any_of(turns_.begin(), turns_.end(),
                       [](const Turn& turn) { return turn.clock.capped(); });
  }
  [[nodiscard]] bool exceeded() const {
    return std::any_of(turns_.begin(), turns_.end(),
                       [](const Turn& turn) { return turn.clock.exceeded(); });
  }

 private:
  struct Turn {
    const Part* part;
    SubstepClock clock;
  };
  std::vector<Turn> turns_;
  std::size_t at_ = 0;
};

}  // namespace substep
