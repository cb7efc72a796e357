#pragma once

#include "core/sim/report.hpp"

namespace substep {

/// Keeps the energy that the user puts into a run apart from what the method adds or loses.
/// Between two frames the scene or a state changes (a ball, an effect): the change of the energy is
/// the user's. In a frame with a hand on a body all of the change is booked as the hand's work: the
/// share of the method in it cannot be measured.
class EnergyAccount {
 public:
  /// @param report of the initial state of the run
  void start(const FrameReport& report) { *this = {report.energy, 0.0}; }
  /// Call after an edit. @param report of the state after it
  void edited(const FrameReport& report) { book(report, true); }
  /// Call after a frame. @param held whether a hand pulled during it
  void add(const FrameReport& report, bool held) { book(report, held); }
  /// Work of the user since the start of the run [J].
  [[nodiscard]] double put_in() const { return put_in_; }

  EnergyAccount() = default;

 private:
  EnergyAccount(double energy, double put_in) : energy_(energy), put_in_(put_in) {}
  void book(const FrameReport& report, bool by_user) {
    if (by_user) put_in_ += report.energy - energy_;
    energy_ = report.energy;
  }

  double energy_ = 0.0;  // at the last call [J]
  double put_in_ = 0.0;
};

}  // namespace substep
