#pragma once

#include <vector>

#include "core/model/part.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {

/// The sub-steps of a frame: the parts of the scene in turn, each with its own clock.
class Schedule {
 public:
  Schedule() { turns_.reserve(16); }
  void clear();
  /// @param part must outlive the frame
  void add(const Part& part, const SubstepClock& clock);

  [[nodiscard]] bool running() const { return at_ < turns_.size(); }
  // Properties of the next sub-step; valid while running().
  [[nodiscard]] const Part& part() const { return *turns_[at_].part; }
  [[nodiscard]] const SubstepClock& clock() const { return turns_[at_].clock; }
  /// Advances to the next sub-step. @param r, r_rotation of the current one, if needed [1/s^2]
  void advance(double r, double r_rotation);

  [[nodiscard]] int left() const;  ///< remaining sub-steps of the frame, as currently planned
  // Over all parts.
  [[nodiscard]] bool moves(int body) const;
  [[nodiscard]] double r() const;  ///< the largest [1/s^2]
  [[nodiscard]] int n_wanted() const;
  [[nodiscard]] bool capped() const;

 private:
  struct Turn {
    const Part* part;
    SubstepClock clock;
  };
  std::vector<Turn> turns_;
  std::size_t at_ = 0;
};

}  // namespace substep
