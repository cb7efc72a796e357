#include "core/lab/hold_search.hpp"

#include <algorithm>
#include <utility>

#include "core/lab/slice.hpp"
#include "core/model/validate.hpp"

namespace substep {

HoldSearch::HoldSearch(std::shared_ptr<const Scene> scene, std::vector<Result> candidates,
                       double seconds, const Reference& reference, Serves serves,
                       const Budget& budget)
    : scene_(not_null(std::move(scene))),
      candidates_(std::move(candidates)),
      seconds_(seconds),
      reference_(&reference),
      serves_(std::move(serves)),
      budget_(budget) {
  candidates_.resize(std::min(candidates_.size(), kMost));
  start();
}

void HoldSearch::start() {
  run_.reset();
  if (failed_.size() == candidates_.size()) return;
  Experiment experiment = candidates_[failed_.size()].experiment;
  const bool is_long = frames_of(*scene_, experiment.duration) >= frames_of(*scene_, seconds_);
  if (is_long && is_runnable(*scene_)) {
    found_ = failed_.size();
    return;
  }
  experiment.duration = seconds_;
  run_ = std::make_unique<ExperimentRun>(*scene_, std::move(experiment), *reference_, budget_);
}

void HoldSearch::advance_by_a_frame() {
  if (run_->advance()) return;
  Result result = run_->result();
  if (result.metrics.holds && (!serves_ || serves_(result))) {
    found_ = failed_.size();
    return;
  }
  failed_.push_back(std::move(result));
  start();
}

bool HoldSearch::advance(double seconds) {
  return advance_for(seconds, [this] {
    if (!done()) advance_by_a_frame();
    return !done();
  });
}

double HoldSearch::progress() const { return done() ? 1.0 : run_->progress(); }

}  // namespace substep
