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

/// One experiment, frame by frame. It ends after its duration or at the first failure.
class ExperimentRun {
 public:
  /// @param scene the scene without the experiment's load and seed
  /// @param reference of that scene; must outlive this. With another load the motion differs, so
  /// the distance from the reference is not measured
  /// @param budget of each of its frames
  ExperimentRun(const Scene& scene, Experiment experiment, const Reference& reference,
                const Budget& budget = {});

  /// Steps one frame, or a part of it. @return false when the run has ended
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
  FrameReport report_;  // of the last complete frame
  const Reference& reference_;
  Measure measure_;
  std::int64_t frames_ = 0;
  double wall_ = 0.0;  // wall time of the current frame [s]
};

}  // namespace substep
