#include "core/lab/remedy.hpp"

#include <algorithm>
#include <utility>

#include "core/lab/slice.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/format_text.hpp"
#include "core/model/validate.hpp"
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
                                    exceeded->what == Exceeded::What::kOverlap ||
                                    exceeded->what == Exceeded::What::kPassage);
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

struct RemedyTrials::Run {
  Run(const std::shared_ptr<const Scene>& scene, const Remedy& remedy, const Trial& trial)
      : simulator(scene) {
    simulator.set_settings(remedy.settings);
    simulator.set_budget(trial.budget);
    simulator.set_measures({.stages = false});
    verdict.emplace(*scene, simulator.state(), simulator.observe());
  }

  Simulator simulator;
  std::optional<Verdict> verdict;
  double work = 0.0;
};

RemedyTrials::RemedyTrials(std::shared_ptr<const Scene> scene, std::vector<Remedy> remedies,
                           const Trial& trial)
    : scene_(not_null(std::move(scene))), remedies_(std::move(remedies)), trial_(trial) {}

RemedyTrials::~RemedyTrials() = default;
RemedyTrials::RemedyTrials(RemedyTrials&&) noexcept = default;
RemedyTrials& RemedyTrials::operator=(RemedyTrials&&) noexcept = default;

bool RemedyTrials::done() const {
  return run_ == nullptr && (next_ >= remedies_.size() || hold_.size() == trial_.enough);
}

bool RemedyTrials::advance() {
  if (done()) return false;
  if (run_ == nullptr) run_ = std::make_unique<Run>(scene_, remedies_[next_++], trial_);
  Run& run = *run_;
  const std::int64_t frame = run.simulator.state().frame;
  const FrameReport report = run.simulator.step_some(kPartWork);
  const bool complete = run.simulator.state().frame > frame;
  if (!complete && report.status == StepStatus::kOk) return true;
  run.verdict->add(*scene_, run.simulator.state(), report);
  run.work += static_cast<double>(report.n_substeps + report.n_discarded) *
              static_cast<double>(scene_->bodies.size());
  if (!run.verdict->holds()) {
    ++failed_;
  } else if (run.simulator.state().frame >= trial_.frames) {
    hold_.push_back(remedies_[next_ - 1]);
  } else if (run.work < trial_.most_work) {
    return true;
  }
  run_.reset();
  return !done();
}

}  // namespace substep
