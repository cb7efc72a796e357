#include "app/effect_costs.hpp"

#include <chrono>
#include <utility>

namespace substep {

void EffectCosts::start(std::shared_ptr<const Scene> scene, Experiment experiment) {
  scene_ = std::move(scene);
  run_.emplace(*scene_, std::move(experiment));
  breakdown_.reset();
  running_ = true;
}

void EffectCosts::advance(double seconds) {
  if (!running_) return;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  do {
    running_ = run_->advance();
  } while (running_ && Clock::now() < end);
  CostBreakdown costs = run_->costs();
  if (costs.run.work.frames > 0) breakdown_ = std::move(costs);
}

}  // namespace substep
