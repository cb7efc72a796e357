#include "core/lab/effect_cost.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/lab/bounded_sample.hpp"
#include "core/lab/slice.hpp"
#include "core/sim/simulator.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {
namespace {

std::shared_ptr<const Scene> without(const Scene& scene, bool Effects::*effect) {
  Scene less = scene;
  less.effects.*effect = false;
  disable_dependents(less.effects);
  return std::make_shared<const Scene>(std::move(less));
}

/// Budget of each simulator: all keep their memory until the end, so together they share the budget
/// of one. They are the run, the unchanged scene, and the scene without each effect.
Budget shared_budget(const Effects& effects, Budget budget) {
  const auto count = 2 + std::count_if(kEffects.begin(), kEffects.end(),
                                       [&](const EffectEntry& e) { return effects.*e.member; });
  budget.memory /= static_cast<double>(count);
  return budget;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Trimmed mean without an eighth at either end, to exclude interrupts and cold caches. A median
/// would be 0 in a browser, whose clock resolution is longer than many frames.
double trimmed_mean(std::vector<double> values) {
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 8);
  std::sort(values.begin(), values.end());
  return mean_of({values.begin() + cut, values.end() - cut});
}

}  // namespace

/// Steps single frames of a scene from given states.
class EffectCostRun::Again {
 public:
  Again(std::shared_ptr<const Scene> scene, std::string_view without, const Budget& budget)
      : simulator_(std::move(scene)), without_(without) {
    simulator_.set_budget(budget);
  }

  void begin(const State& state, const Settings& settings) {
    simulator_.set_settings(settings);
    simulator_.set_state(state);
  }
  /// Steps a part of the frame. @return true if it is complete
  bool advance() {
    const FrameReport report = simulator_.step_some(kPartWork);
    if (simulator_.substeps_left() > 0) return false;
    last_ = {without_, 1e3 * report.times.total, static_cast<double>(report.work.flops),
             static_cast<double>(report.work.row_updates)};
    return true;
  }

  /// Adds the cost of the last frame of the unchanged scene minus that of this one.
  void compare(const Again& whole) {
    ++frames_;
    ms_.add(whole.last_.ms - last_.ms);
    sum_.flops += whole.last_.flops - last_.flops;
    sum_.row_updates += whole.last_.row_updates - last_.row_updates;
  }

  /// Mean of what was compared.
  [[nodiscard]] EffectCost spared() const {
    EffectCost cost{without_};
    if (frames_ == 0) return cost;
    const auto frames = static_cast<double>(frames_);
    cost.ms = trimmed_mean(ms_.values());
    cost.flops = sum_.flops / frames;
    cost.row_updates = sum_.row_updates / frames;
    return cost;
  }

 private:
  Simulator simulator_;
  std::string_view without_;  // the disabled effect, or ""
  EffectCost last_;           // of the last frame as a whole
  EffectCost sum_;            // of what was compared; whole numbers, so that their sum is exact
  BoundedSample ms_;          // of what was compared
  std::int64_t frames_ = 0;   // compared
};

EffectCostRun::EffectCostRun(const Scene& scene, Experiment experiment, const Budget& budget)
    : run_(scene, std::move(experiment), no_reference(), shared_budget(scene.effects, budget)) {
  const Scene& start = run_.simulator().scene();
  const Budget share = run_.simulator().budget();
  again_.emplace_back(std::make_shared<const Scene>(start), "", share);
  for (const EffectEntry& effect : kEffects) {
    if (!(start.effects.*effect.member)) continue;
    again_.emplace_back(without(start, effect.member), effect.name, share);
  }
  next_ = again_.size();
  same_ = run_.experiment().settings;
  // Islands have their own N, which follows from the state of their bodies.
  if (!has_islands(same_)) same_.mode = Mode::kConst;
}

EffectCostRun::~EffectCostRun() = default;

bool EffectCostRun::advance() {
  if (next_ < again_.size()) {
    if (again_[next_].advance()) {
      if (next_ > 0) again_[next_].compare(again_.front());
      ++next_;
    }
  } else if (more_) {
    if (run_.simulator().substeps_left() == 0) before_ = run_.simulator().state();
    more_ = run_.advance();
    if (run_.simulator().substeps_left() > 0) return true;
    if (run_.simulator().state().frame == before_.frame) return false;  // it could not be stepped
    same_.n = std::max(1, run_.report().n_substeps);
    for (Again& again : again_) again.begin(before_, same_);
    next_ = 0;
  }
  return more_ || next_ < again_.size();
}

CostBreakdown EffectCostRun::costs() const {
  CostBreakdown costs{run_.result().metrics, {}};
  for (std::size_t i = 1; i < again_.size(); ++i) {
    costs.effects.push_back(again_[i].spared());
  }
  return costs;
}

CostBreakdown cost_of_effects(const Scene& scene, const Experiment& experiment) {
  EffectCostRun run(scene, experiment);
  while (run.advance()) {
  }
  return run.costs();
}

}  // namespace substep
