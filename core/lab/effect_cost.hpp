#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

/// Cost of an effect per frame: the frame minus the same frame without the effect. Negative if the
/// effect saves more than it costs.
struct EffectCost {
  std::string_view effect;   // name in scene files
  double ms = 0.0;           // wall time, trimmed mean over frames [ms]
  double flops = 0.0;        // of the solver, mean over frames
  double row_updates = 0.0;  // of PGS and XPBD, mean over frames
};

struct CostBreakdown {
  Metrics run;                      // stages, rows by kind and the criterion
  std::vector<EffectCost> effects;  // those of the scene
};

/// Runs an experiment and repeats each frame from the same state with the same number of sub-steps,
/// once unchanged and once without each effect. The motion is the same, so the difference is the
/// cost of the effect, even in the direct solver, which eliminates rows of all kinds together.
/// Islands with their own N recompute it; a common N due to coupling by an effect is part of its
/// cost. Without contact there is no friction and no restitution. Works in parts of a single frame,
/// to keep a page responsive. Its memory does not grow with the frames: times of more than
/// BoundedSample::kMost frames are those of a sample.
class EffectCostRun {
 public:
  /// @param scene without the experiment's load and seed
  /// @param budget of a frame; its memory is shared by all simulators
  EffectCostRun(const Scene& scene, Experiment experiment, const Budget& budget = {});
  ~EffectCostRun();
  EffectCostRun(const EffectCostRun&) = delete;
  EffectCostRun& operator=(const EffectCostRun&) = delete;

  /// Steps a part of a frame of the run or of a repetition. @return false when done
  bool advance();
  [[nodiscard]] double progress() const { return run_.progress(); }  ///< 0 to 1
  /// Costs of the frames so far.
  [[nodiscard]] CostBreakdown costs() const;
  [[nodiscard]] const Experiment& experiment() const { return run_.experiment(); }

 private:
  class Again;

  ExperimentRun run_;
  std::vector<Again> again_;  // the unchanged scene, then without each of its effects
  std::size_t next_ = 0;      // next of `again_`, starting from `before_`
  State before_;              // start of the repeated frame
  Settings same_;             // with the number of sub-steps of the run
  bool more_ = true;          // the run has more frames
};

/// The same in one call.
CostBreakdown cost_of_effects(const Scene& scene, const Experiment& experiment);

}  // namespace substep
