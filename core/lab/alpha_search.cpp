#include "core/lab/alpha_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/lab/slice.hpp"
#include "core/model/number_text.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr double kQuarter = 0.25;
constexpr int kMostQuarters = 8;  // from 1 to kLeast
constexpr double kNarrow = 1.02;  // ratio of the ends of an interval that is not halved
constexpr int kMostHalvings = 7;  // of a quarter until it is narrow

}  // namespace

AlphaSearch AlphaSearch::largest_within(std::shared_ptr<const Scene> scene,
                                        const Experiment& experiment, const Reference& reference,
                                        ErrorAxis axis, double error, const Budget& budget) {
  return {std::move(scene),
          experiment,
          reference,
          [axis, error](const Result& result) {
            const auto value = error_of(result, axis);
            return value && *value <= error;
          },
          true,
          budget};
}

AlphaSearch AlphaSearch::smallest_within(std::shared_ptr<const Scene> scene,
                                         const Experiment& experiment, const Reference& reference,
                                         CostAxis axis, double cost, const Budget& budget) {
  return {std::move(scene),
          experiment,
          reference,
          [axis, cost](const Result& result) { return cost_of(result, axis) <= cost; },
          false,
          budget};
}

AlphaSearch::AlphaSearch(std::shared_ptr<const Scene> scene, const Experiment& experiment,
                         const Reference& reference, Serves serves, bool until_it_serves,
                         const Budget& budget)
    : scene_(not_null(std::move(scene))),
      experiment_(experiment),
      reference_(&reference),
      serves_(std::move(serves)),
      until_it_serves_(until_it_serves),
      budget_(budget),
      quarters_(kMostQuarters) {
  start();
}

void AlphaSearch::start() {
  experiment_.settings.alpha = alpha_;
  run_ = std::make_unique<ExperimentRun>(*scene_, experiment_, *reference_, budget_);
  ++runs_;
}

void AlphaSearch::advance_by_a_frame() {
  if (run_->advance()) return;
  take(run_->result());
  run_.reset();
  if (!done()) start();
}

bool AlphaSearch::advance(double seconds) {
  return advance_for(seconds, [this] {
    if (!done()) advance_by_a_frame();
    return !done();
  });
}

double AlphaSearch::progress() const {
  if (done()) return 1.0;
  return (runs_ - 1 + run_->progress()) / (quarters_ + kMostHalvings);
}

void AlphaSearch::take(const Result& result) {
  const bool serves = serves_(result);
  if (serves) {
    good_ = AlphaChoice{alpha_, result};
  } else {
    bad_ = alpha_;
  }
  if (phase_ == Phase::kDown) {
    if (serves != until_it_serves_ && alpha_ > kLeast) {
      alpha_ = std::max(three_digits(kQuarter * alpha_), kLeast);
      return;
    }
    phase_ = Phase::kHalving;
    quarters_ = runs_;
  }
  // One end may be missing, if the whole range or no part of it satisfies the criterion.
  if (!good_ || bad_ == 0.0 || std::max(bad_ / good_->alpha, good_->alpha / bad_) <= kNarrow) {
    phase_ = Phase::kDone;
    if (good_ && !good_->result.metrics.holds) good_.reset();
    return;
  }
  // The geometric mean differs from both ends by about 1 %, and rounding to three digits changes it
  // by at most 0.5 %, so this alpha has not been run.
  alpha_ = three_digits(std::sqrt(bad_ * good_->alpha));
}

}  // namespace substep
