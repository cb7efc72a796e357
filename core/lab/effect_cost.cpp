#include "core/lab/effect_cost.hpp"

#include <algorithm>
#include <functional>

#include "core/sim/simulator.hpp"

namespace substep {
namespace {

struct Named {
  std::string_view name;
  bool Effects::*effect;
};
constexpr Named kEffects[] = {
    {"gravity", &Effects::gravity},   {"gyroscopic", &Effects::gyroscopic},
    {"joints", &Effects::joints},     {"contact", &Effects::contact},
    {"friction", &Effects::friction}, {"restitution", &Effects::restitution}};

std::shared_ptr<const Scene> without(const Scene& scene, bool Effects::*effect) {
  Scene less = scene;
  less.effects.*effect = false;
  if (!less.effects.contact) less.effects.friction = less.effects.restitution = false;
  return std::make_shared<const Scene>(std::move(less));
}

/// Single frames of a scene from given states.
class Again {
 public:
  explicit Again(std::shared_ptr<const Scene> scene) : simulator_(std::move(scene)) {}

  void step(const State& state, const Settings& settings) {
    simulator_.set_settings(settings);
    simulator_.set_state(state);
    const FrameReport report = simulator_.step();
    ms_.push_back(1e3 * report.times.total);
    flops_ += static_cast<double>(report.work.flops);
    row_updates_ += static_cast<double>(report.work.row_updates);
  }

  /// What this costs more than the other, whose frames are the same.
  [[nodiscard]] EffectCost over(const Again& other, std::string_view effect) const {
    EffectCost cost{effect};
    if (ms_.empty()) return cost;
    std::vector<double> more(ms_.size());
    std::transform(ms_.begin(), ms_.end(), other.ms_.begin(), more.begin(), std::minus<>());
    const auto middle = more.begin() + static_cast<std::ptrdiff_t>(more.size() / 2);
    std::nth_element(more.begin(), middle, more.end());
    const auto frames = static_cast<double>(ms_.size());
    cost.ms = *middle;
    cost.flops = (flops_ - other.flops_) / frames;
    cost.row_updates = (row_updates_ - other.row_updates_) / frames;
    return cost;
  }

 private:
  Simulator simulator_;
  std::vector<double> ms_;  // by frame [ms]
  double flops_ = 0.0;
  double row_updates_ = 0.0;
};

}  // namespace

CostBreakdown cost_of_effects(const std::shared_ptr<const Scene>& scene,
                              const Experiment& experiment) {
  const Reference none;
  ExperimentRun run(*scene, experiment, none);
  const Scene& start = run.simulator().scene();
  Again whole(std::make_shared<const Scene>(start));
  std::vector<std::string_view> names;
  std::vector<Again> less;
  for (const auto& [name, effect] : kEffects) {
    if (!(start.effects.*effect)) continue;
    names.push_back(name);
    less.emplace_back(without(start, effect));
  }
  Settings same = experiment.settings;
  same.mode = Mode::kConst;
  for (bool more = true; more;) {
    const State before = run.simulator().state();
    more = run.advance();
    if (run.simulator().state().frame == before.frame) break;  // it could not be stepped
    same.n = std::max(1, run.report().n_substeps);
    whole.step(before, same);
    for (Again& one : less) one.step(before, same);
  }
  CostBreakdown costs{run.result().metrics, {}};
  for (std::size_t i = 0; i < less.size(); ++i) {
    costs.effects.push_back(whole.over(less[i], names[i]));
  }
  return costs;
}

}  // namespace substep
