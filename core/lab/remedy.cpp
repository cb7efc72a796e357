#include "core/lab/remedy.hpp"

#include <algorithm>

#include "core/lab/verdict.hpp"
#include "core/model/format_text.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

constexpr int kMostCap = 1024;          // the cost of a larger one exceeds its benefit
constexpr double kLeastOffered = 1e-3;  // 10 times the sub-steps of 0.1

/// A new cap: the requested N, at least 2 and at most 16 times the current cap.
int larger(int cap, int wanted) {
  return std::min(std::clamp(wanted, 2 * cap, 16 * cap), std::max(cap, kMostCap));
}

}  // namespace

std::vector<Remedy> remedies(const Settings& settings, const FrameReport& last,
                             const std::optional<Exceeded>& exceeded) {
  std::vector<Remedy> all;
  if (last.status == StepStatus::kTooManyContacts ||  // not due to the settings
      last.status == StepStatus::kOverBudget || last.status == StepStatus::kInvalid) {
    return all;
  }
  const auto add = [&](const std::string& text, const std::string& why = {}) -> Settings& {
    return all.emplace_back(Remedy{text, why, settings}).settings;
  };
  // A smaller alpha cures neither a gain of energy nor a contact that is found too late.
  const bool of_rule = exceeded && (exceeded->what == Exceeded::What::kEnergyGain ||
                                    exceeded->what == Exceeded::What::kOverlap);
  const auto add_defaults = [&] {
    Settings ours;
    ours.watch_stiffness = settings.watch_stiffness;  // display only
    if (settings != ours) {
      add("the default settings", "they keep the energy and find contacts in time") = ours;
    }
  };
  if (of_rule) add_defaults();
  if (last.stages.gyroscopic && settings.gyroscopic == Gyroscopic::kExplicit) {
    add("an implicit gyroscopic torque").gyroscopic = Gyroscopic::kImplicit;
  }
  const bool adaptive = settings.mode == Mode::kAdaptive;
  const bool has_rows = last.joint_rows + last.contact_rows > 0;
  if (!adaptive && has_rows) {  // without rows N is 1
    add("adaptive sub-steps").mode = Mode::kAdaptive;
  }
  if (adaptive && last.capped) {
    const int n_max = larger(settings.n_max, last.n_wanted);
    if (n_max > settings.n_max) {
      add("a larger cap, " + std::to_string(n_max) + " sub-steps per frame",
          std::to_string(last.n_wanted) + " were required")
          .n_max = n_max;
    }
  }
  if (settings.solver == SolverKind::kPgs) {
    add("the direct solver").solver = SolverKind::kBpp;
  }
  if (adaptive && last.joint_rows > 0 && last.contact_rows > 0 &&
      drift_law(settings) == Drift::kFull) {
    add("the soft drift law",
        "impacts change N, and short steps then correct errors of long ones too fast")
        .drift = Drift::kSoft;
  }
  if (of_rule && adaptive) return all;
  if (adaptive && !last.capped && settings.alpha > kLeastOffered) {
    const double alpha = std::max(kLeastOffered, 0.5 * settings.alpha);
    add(format_text("a smaller alpha, %.3g", alpha)).alpha = alpha;
  }
  if (adaptive && settings.policy == Policy::kFrame) {
    add("a decision after every sub-step").policy = Policy::kSubstep;
  }
  if (!of_rule) add_defaults();
  return all;
}

TriedRemedies try_remedies(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                           const FrameReport& failed, const std::optional<Exceeded>& exceeded,
                           const Trial& trial) {
  TriedRemedies tried;
  for (Remedy& remedy : remedies(settings, failed, exceeded)) {
    if (tried.hold.size() == trial.enough || trial.cancelled()) break;
    Simulator simulator(scene);
    simulator.set_settings(remedy.settings);
    simulator.set_budget(trial.budget);
    simulator.set_measures({.stages = false});
    Verdict verdict(*scene, simulator.state(), simulator.observe());
    double work = 0.0;
    std::int64_t frame = 0;
    for (; frame < trial.frames && verdict.holds() && work < trial.most_work; ++frame) {
      if (trial.cancelled()) return tried;
      const FrameReport report = simulator.step();
      verdict.add(*scene, simulator.state(), report);
      work += static_cast<double>(report.n_substeps + report.n_discarded) *
              static_cast<double>(scene->bodies.size());
    }
    if (!verdict.holds()) ++tried.failed;
    if (verdict.holds() && frame == trial.frames) tried.hold.push_back(std::move(remedy));
  }
  return tried;
}

}  // namespace substep
