#include "app/lab/effect_costs.hpp"

#include <utility>

#include "app/lab/frame_slices.hpp"
#include "core/lab/slice.hpp"

namespace substep {

void EffectCosts::start(std::shared_ptr<const Scene> scene, Experiment experiment) {
  scene_ = std::move(scene);
  run_.emplace(*scene_, std::move(experiment), kWindowBudget);
  breakdown_.reset();
  running_ = true;
}

void EffectCosts::advance(double seconds) {
  if (!running_) return;
  running_ = advance_for(seconds, [this] { return run_->advance(); });
  CostBreakdown costs = run_->costs();
  if (costs.run.work.frames > 0) breakdown_ = std::move(costs);
}

}  // namespace substep
