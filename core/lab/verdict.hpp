#pragma once

#include <optional>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// A criterion of the scene and the value that exceeds it.
struct Exceeded {
  enum class What { kJointGap, kEnergyGain, kMoved };
  What what = What::kJointGap;
  double value = 0.0;  // [m], of an energy [J]
  double limit = 0.0;  // in the same unit
  std::string name;    // of the joint or body, empty for an energy
};

/// Checks a run against its scene's criteria: the single implementation for browser, command line
/// and tests.
class Verdict {
 public:
  /// @param start report of the initial state of the run (Simulator::observe)
  Verdict(const Scene& scene, const State& state, const FrameReport& start);

  /// Checks one more frame. The first failure is final.
  void add(const Scene& scene, const State& state, const FrameReport& report);

  /// The user has interfered: from now on energy and displacement are not checked; torn joints and
  /// non-finite numbers still are. @param time [s]
  void disturb(double time);

  [[nodiscard]] bool holds() const { return !failed_; }
  [[nodiscard]] bool disturbed() const { return disturbed_; }
  [[nodiscard]] double failed_at() const { return failed_at_; }  ///< [s], for a failed run
  /// True if the simulator cannot continue: StepStatus.
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// The largest ratio of a criterion's value to its limit so far [-].
  [[nodiscard]] double utilisation() const { return utilisation_; }
  /// The criterion that failed the run; empty if it holds or cannot continue.
  [[nodiscard]] const std::optional<Exceeded>& exceeded() const { return exceeded_; }
  /// "holds", "disturbed at 1.20 s", or "fails at 0.352 s: joint gap 0.13 m > 0.1 m (link_3)".
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool failed_ = false;
  bool disturbed_ = false;
  bool stopped_ = false;
  double failed_at_ = 0.0;
  double utilisation_ = 0.0;
  double energy_at_start_ = 0.0;
  Vec3 watched_start_ = Vec3::Zero();
  std::optional<Exceeded> exceeded_;
  std::string text_ = "holds";
};

}  // namespace substep
