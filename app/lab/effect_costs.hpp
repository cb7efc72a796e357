#pragma once

#include <memory>
#include <optional>

#include "core/lab/effect_cost.hpp"

namespace substep {

/// "Where does the time go?": the cost of stages, effects and the criterion in a scene with given
/// settings, measured from its start in slices between frames.
class EffectCosts {
 public:
  /// Starts a measurement. Discards earlier results.
  /// @param scene without the experiment's load and seed applied
  void start(std::shared_ptr<const Scene> scene, Experiment experiment);
  /// Stops before the next frame. Keeps the results so far.
  void cancel() { running_ = false; }
  /// Continues the measurement, if it runs. @param seconds budget in this frame
  void advance(double seconds);

  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] double progress() const { return run_ ? run_->progress() : 0.0; }  ///< 0 to 1
  /// The scene and the experiment measured; null if there are none.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  [[nodiscard]] const Experiment* experiment() const {
    return run_ ? &run_->experiment() : nullptr;
  }
  /// Breakdown of the frames so far; null before the first.
  [[nodiscard]] const CostBreakdown* breakdown() const {
    return breakdown_ ? &*breakdown_ : nullptr;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  std::optional<EffectCostRun> run_;
  std::optional<CostBreakdown> breakdown_;
  bool running_ = false;
};

}  // namespace substep
