#pragma once

#include <memory>
#include <optional>

#include "core/lab/effect_cost.hpp"

namespace substep {

/// "Where does the time go?": what stages, effects and the criterion take in a scene with given
/// settings, measured from its start in slices beside the frames.
class EffectCosts {
 public:
  /// Measures this; what was there before is forgotten.
  /// @param scene as it stands, without the experiment's load and seed
  void start(std::shared_ptr<const Scene> scene, Experiment experiment);
  /// Stops within the frame. What was measured so far stays.
  void cancel() { running_ = false; }
  /// Goes on for about so long, where it runs. @param seconds of this frame's time
  void advance(double seconds);

  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] double progress() const { return run_ ? run_->progress() : 0.0; }  ///< 0 to 1
  /// What is measured, and in which scene; null where nothing was.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  [[nodiscard]] const Experiment* experiment() const {
    return run_ ? &run_->experiment() : nullptr;
  }
  /// Of the frames so far; null before the first one is done.
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
