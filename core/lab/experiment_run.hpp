#pragma once

#include "core/lab/experiment.hpp"
#include "core/lab/metrics.hpp"
#include "core/lab/reference.hpp"
#include "core/sim/simulator.hpp"

namespace substep {

struct Result {
  Experiment experiment;
  Metrics metrics;
  ReferenceSummary reference;
};

/// One experiment, frame by frame. It ends with its duration or with its first failure.
class ExperimentRun {
 public:
  /// @param scene the scene as it stands, without the experiment's load and seed
  /// @param reference of the scene as it stands; must outlive this. Another load moves otherwise:
  /// its distance from the reference is not measured
  /// @param budget of each of its frames
  ExperimentRun(const Scene& scene, Experiment experiment, const Reference& reference,
                const Budget& budget = {});

  /// One more frame, or a part of it. @return false when the run is over
  bool advance();
  [[nodiscard]] double progress() const;  ///< 0 to 1
  [[nodiscard]] Result result() const;
  [[nodiscard]] const Verdict& verdict() const { return measure_.verdict(); }
  [[nodiscard]] const Experiment& experiment() const { return experiment_; }
  [[nodiscard]] const Simulator& simulator() const { return simulator_; }
  [[nodiscard]] const FrameReport& report() const { return report_; }

 private:
  Experiment experiment_;
  Simulator simulator_;
  FrameReport report_;  // of the last frame that is complete
  const Reference& reference_;
  Measure measure_;
  std::int64_t frames_ = 0;
  double wall_ = 0.0;  // of the frame so far [s]
};

}  // namespace substep
