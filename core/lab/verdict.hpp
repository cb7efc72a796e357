#pragma once

#include <string>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// Watches a run against its scene's criteria: the one judge of browser, command line and tests.
class Verdict {
 public:
  /// @param start report of the state that the run starts from (Simulator::observe)
  Verdict(const Scene& scene, const State& state, const FrameReport& start);

  /// Looks at one more frame. After the first failure nothing changes.
  void add(const Scene& scene, const State& state, const FrameReport& report);

  /// Somebody took a hand in it: from now on energy and displacement are his doing and are not
  /// judged; joints that tear and numbers that are not finite are. @param time [s]
  void disturb(double time);

  [[nodiscard]] bool holds() const { return !failed_; }
  [[nodiscard]] bool disturbed() const { return disturbed_; }
  [[nodiscard]] double failed_at() const { return failed_at_; }  ///< [s], of a failed run
  /// Whether the simulator can go no further: StepStatus.
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// The largest share of a criterion's limit that was used so far [-]; 1 is at the limit.
  [[nodiscard]] double strain() const { return strain_; }
  /// "holds", "disturbed at 1.20 s", or "fails at 0.352 s: joint gap 0.13 m > 0.1 m (link_3)".
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool failed_ = false;
  bool disturbed_ = false;
  bool stopped_ = false;
  double failed_at_ = 0.0;
  double strain_ = 0.0;
  double energy_at_start_ = 0.0;
  Vec3 watched_start_ = Vec3::Zero();
  std::string text_ = "holds";
};

}  // namespace substep
