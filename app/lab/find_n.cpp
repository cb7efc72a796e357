#include "app/lab/find_n.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "app/lab/accuracy.hpp"
#include "app/lab/frame_slices.hpp"
#include "core/io/all_methods.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/slice.hpp"
#include "core/lab/sweep.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr std::int64_t kCheckEvery = 16;  // frames
// Shares of the progress bar, up to the end of each stage.
constexpr double kSubstepsFrom = 0.04;
constexpr double kReferenceFrom = 0.12;
constexpr double kMethodsFrom = 0.25;
constexpr double kWholeFrom = 0.95;

}  // namespace

double FindN::slice(double drawing) {
  constexpr double kLeast = 0.010;  // leaves a third of a frame of the display for drawing
  return std::max(kLeast, Accuracy::slice(false, drawing));
}

bool FindN::has(ErrorAxis axis, const Scene& scene) {
  if (axis == ErrorAxis::kGap) return scene.effects.joints && !scene.joints.empty();
  if (axis == ErrorAxis::kPenetration) return scene.effects.contact;
  return true;
}

bool FindN::reference_serves(double limit) const {
  if (axis_ != ErrorAxis::kTrajectory) return true;
  // A refined one depends on the limit that it was refined for.
  return !reference_.source.empty() && reference_.failure.empty() &&
         reference_.source == first_source_ &&
         kTimesAsCertain * reference_.uncertainty <= std::min(limit, wanted_);
}

void FindN::start(const FindScene& of, ErrorAxis axis, double limit) {
  const bool kept = of == of_ && axis == axis_ && !experiments_.empty() && reference_serves(limit);
  run_.reset();
  trial_.reset();
  finding_.reset();
  survey_.reset();
  failed_.clear();
  found_.reset();
  failure_.clear();
  cancelled_ = false;
  progress_ = 0.0;
  wanted_ = limit_ = limit;
  if (kept) {
    for (Try& t : tries_) t.fails_whole = false;
    update_bounds();
    plan();
    stage_ = Stage::kMethods;
    return;
  }
  of_ = of;
  axis_ = axis;
  scene_ = of.load == 1.0 && of.seed == 0
               ? of.plain
               : std::make_shared<const Scene>(start_of(*of.plain, of.load, of.seed));
  reference_ = {};
  first_source_.clear();
  energy_changes_.clear();
  chosen_body_.clear();
  experiments_.clear();
  tries_.clear();
  curve_.clear();
  preview_.clear();
  results_.clear();
  ids_.clear();
  queue_.clear();
  next_ = 0;
  if (auto refusal = refusal_of(scene_.get())) return finish("It cannot run: " + *refusal + ".");
  const double frame = scene_->frame;
  const double seconds = static_cast<double>(frames_of(*scene_, scene_->criteria.duration)) * frame;
  compared_ = axis == ErrorAxis::kTrajectory ? predictable_window(*scene_, seconds) : seconds;
  whole_ = std::max(seconds, scene_->criteria.duration);
  const bool chooses = axis == ErrorAxis::kTrajectory && !scene_->criteria.track;
  stage_ = Stage::kSurvey;
  if (chooses || axis == ErrorAxis::kEnergy) {
    survey_.emplace(scene_, predictable_window(*scene_, seconds), kWindowBudget);
  }
}

void FindN::advance(double seconds) {
  if (!busy()) return;
  advance_for(seconds, [this] {
    step();
    return busy();
  });
  note_progress();
}

void FindN::step() {
  switch (stage_) {
    case Stage::kSurvey:
      if (survey_ && survey_->advance()) return;
      return begin_runs();
    case Stage::kSubsteps:
      return step_substeps();
    case Stage::kReference:
      return step_reference();
    case Stage::kMethods:
      return step_methods();
    case Stage::kWhole:
      return step_whole();
    case Stage::kIdle:
    case Stage::kDone:
      return;
  }
}

void FindN::begin_runs() {
  if (axis_ == ErrorAxis::kTrajectory && !scene_->criteria.track) {
    if (!survey_->farthest()) return finish("No body leaves its place, so no path is compared.");
    Scene tracking = *scene_;
    tracking.criteria.track = survey_->farthest();
    scene_ = std::make_shared<const Scene>(std::move(tracking));
    chosen_body_ = scene_->bodies[index(*scene_->criteria.track)].name;
  }
  if (axis_ == ErrorAxis::kEnergy) {
    energy_changes_ = energy_changes_by(*scene_, survey_->touches());
  }
  survey_.reset();
  experiments_ = all_methods(*scene_, compared_, true);
  tries_.assign(experiments_.size(), {});
  const std::string paper = series_name(paper_settings(*scene_));
  for (std::size_t i = 0; i < experiments_.size(); ++i) {
    if (series_name(experiments_[i].settings) != paper) continue;
    tries_[i].on_curve = true;
    curve_.push_back(i);
  }
  std::stable_sort(curve_.begin(), curve_.end(), [&](std::size_t a, std::size_t b) {
    return experiments_[a].settings.alpha > experiments_[b].settings.alpha;
  });
  update_bounds();
  plan();
  stage_ = axis_ == ErrorAxis::kTrajectory ? Stage::kSubsteps : Stage::kMethods;
}

void FindN::step_substeps() {
  if (!run_ && preview_.size() == curve_.size()) {
    finding_.emplace(scene_, compared_, kWindowBudget, wanted_ / kTimesAsCertain);
    first_source_ = finding_->source();
    stage_ = Stage::kReference;
    return;
  }
  if (!run_) {
    run_ = std::make_unique<ExperimentRun>(*scene_, experiments_[curve_[preview_.size()]],
                                           no_reference(), kWindowBudget);
  }
  if (run_->advance()) return;
  preview_.push_back(run_->result());
  run_.reset();
}

void FindN::step_reference() {
  if (finding_->advance()) return;
  reference_ = finding_->reference();
  finding_.reset();
  limit_ = promise(reference_, wanted_);
  if (!std::isfinite(limit_)) {
    return finish(reference_.failure.empty()
                      ? "The motion is too uncertain: no error of the path can be promised."
                      : "The reference run " + reference_.failure +
                            ", so no error of the path can be promised.");
  }
  update_bounds();
  plan();
  stage_ = Stage::kMethods;
}

/// The curve first, then the runs that are expected to be cheap: they bound the others.
void FindN::plan() {
  queue_.clear();
  next_ = 0;
  for (const std::size_t i : curve_) {
    if (matters(i)) queue_.push_back(i);
  }
  std::vector<std::size_t> others;
  std::vector<double> work(experiments_.size());
  for (std::size_t i = 0; i < experiments_.size(); ++i) {
    work[i] = expected_work(*scene_, experiments_[i]);
    if (!tries_[i].on_curve && matters(i)) others.push_back(i);
  }
  std::stable_sort(others.begin(), others.end(),
                   [&](std::size_t a, std::size_t b) { return work[a] < work[b]; });
  queue_.insert(queue_.end(), others.begin(), others.end());
}

bool FindN::matters(std::size_t index) const {
  const Try& t = tries_[index];
  switch (t.end) {
    case Try::End::kNone:
      return true;
    case Try::End::kComplete:
      return false;
    case Try::End::kError:
      return t.reached <= std::max(limit_, least_error_);
    case Try::End::kCost:
      return t.reached <= least_cost_;
  }
  return false;
}

void FindN::update_bounds() {
  least_error_ = least_cost_ = kNoBound;
  for (const RunPoint& p : run_points(results_, axis_, CostAxis::kOperations)) {
    least_error_ = std::min(least_error_, p.error);
    const bool serves = p.error <= limit_ && !tries_[ids_[p.result]].fails_whole;
    if (serves) least_cost_ = std::min(least_cost_, p.cost);
  }
}

void FindN::take(Result result) {
  const auto at = std::lower_bound(ids_.begin(), ids_.end(), running_);
  results_.insert(results_.begin() + (at - ids_.begin()), std::move(result));
  ids_.insert(at, running_);
  tries_[running_].end = Try::End::kComplete;
  update_bounds();
}

void FindN::step_methods() {
  if (!run_) {
    while (next_ < queue_.size() && !matters(queue_[next_])) ++next_;
    if (next_ == queue_.size()) {
      stage_ = Stage::kWhole;
      return;
    }
    running_ = queue_[next_++];
    checked_ = 0;
    const Reference& reference = axis_ == ErrorAxis::kTrajectory ? reference_ : no_reference();
    run_ =
        std::make_unique<ExperimentRun>(*scene_, experiments_[running_], reference, kWindowBudget);
    return;
  }
  if (!run_->advance()) {
    take(run_->result());
    run_.reset();
    return;
  }
  Try& now = tries_[running_];
  const std::int64_t frame = run_->simulator().state().frame;
  if (now.on_curve || frame == checked_ || frame % kCheckEvery != 0) return;
  checked_ = frame;
  const Result so_far = run_->result();
  const double cost = static_cast<double>(so_far.metrics.work.flops) /
                      static_cast<double>(frames_of(*scene_, compared_));
  const double error = error_of(so_far, axis_).value_or(0.0);
  // The run with the smallest error is wanted if none is within the limit.
  if (error > std::max(limit_, least_error_)) {
    now.end = Try::End::kError;
    now.reached = error;
  } else if (cost > least_cost_) {
    now.end = Try::End::kCost;
    now.reached = cost;
  } else {
    return;
  }
  run_.reset();
}

std::optional<std::size_t> FindN::cheapest() const {
  const auto points = run_points(results_, axis_, CostAxis::kOperations);
  for (const RunPoint& p : cheapest_first(points, limit_)) {
    if (!tries_[ids_[p.result]].fails_whole) return p.result;
  }
  return std::nullopt;
}

void FindN::step_whole() {
  if (!trial_) {
    const auto best = cheapest();
    if (!best || failed_.size() == HoldSearch::kMost) return finish();
    on_trial_ = ids_[*best];
    trial_.emplace(
        scene_, std::vector<Result>{results_[*best]}, whole_,
        axis_ == ErrorAxis::kTrajectory ? reference_ : no_reference(),
        [axis = axis_, limit = limit_](const Result& result) {
          const auto error = error_of(result, axis);
          return error && *error <= limit;
        },
        kWindowBudget);
  } else {
    trial_->advance(0.0);
  }
  if (!trial_->done()) return;
  if (trial_->found()) {
    found_ = on_trial_;
    return finish();
  }
  failed_.push_back(trial_->failed().front());
  trial_.reset();
  tries_[on_trial_].fails_whole = true;
  // Runs that were too expensive beside this one may be the next.
  update_bounds();
  plan();
  stage_ = Stage::kMethods;
}

void FindN::finish(std::string why) {
  failure_ = std::move(why);
  stage_ = Stage::kDone;
  progress_ = 1.0;
}

void FindN::note_progress() {
  const auto share = [](std::size_t done, double part, std::size_t all) {
    return all == 0 ? 1.0
                    : std::min(1.0, (static_cast<double>(done) + part) / static_cast<double>(all));
  };
  const double part = run_ ? run_->progress() : 0.0;
  double now = progress_;
  switch (stage_) {
    case Stage::kSubsteps:
      now = kSubstepsFrom +
            (kReferenceFrom - kSubstepsFrom) * share(preview_.size(), part, curve_.size());
      break;
    case Stage::kReference:
      now = kReferenceFrom + (kMethodsFrom - kReferenceFrom) * finding_->progress();
      break;
    case Stage::kMethods:
      now = kMethodsFrom +
            (kWholeFrom - kMethodsFrom) * share(next_ - (run_ ? 1 : 0), part, queue_.size());
      break;
    case Stage::kWhole:
      now = kWholeFrom + (1.0 - kWholeFrom) * (trial_ ? trial_->progress() : 0.0);
      break;
    case Stage::kIdle:
    case Stage::kSurvey:
    case Stage::kDone:
      break;
  }
  progress_ = std::max(progress_, now);  // it may return to the methods
}

std::vector<FindN::AlphaPoint> FindN::along_alpha() const {
  std::vector<AlphaPoint> points;
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    const auto at = std::lower_bound(ids_.begin(), ids_.end(), curve_[i]);
    const Result* result = nullptr;
    if (at != ids_.end() && *at == curve_[i]) {
      result = &results_[static_cast<std::size_t>(at - ids_.begin())];
    } else if (i < preview_.size()) {
      result = &preview_[i];
    } else {
      continue;
    }
    points.push_back({result->experiment.settings.alpha, cost_of(*result, CostAxis::kSubsteps),
                      result->metrics.holds, error_of(*result, axis_), result});
  }
  return points;
}

FindN::Count FindN::count() const {
  Count count{.planned = experiments_.size(), .complete = results_.size()};
  for (const Result& result : results_) count.held += result.metrics.holds ? 1U : 0U;
  for (const Try& t : tries_) {
    count.error += t.end == Try::End::kError ? 1U : 0U;
    count.cost += t.end == Try::End::kCost ? 1U : 0U;
  }
  return count;
}

const Result* FindN::best() const {
  if (!found_) return nullptr;
  const auto at = std::lower_bound(ids_.begin(), ids_.end(), *found_);
  return &results_[static_cast<std::size_t>(at - ids_.begin())];
}

const Result* FindN::best_so_far() const {
  const auto best = cheapest();
  return best ? &results_[*best] : nullptr;
}

const Result* FindN::nearest() const {
  const auto points = run_points(results_, axis_, CostAxis::kOperations);
  const auto least =
      std::min_element(points.begin(), points.end(),
                       [](const RunPoint& p, const RunPoint& q) { return p.error < q.error; });
  return least == points.end() ? nullptr : &results_[least->result];
}

const Result* FindN::best_of_paper() const {
  const auto points = run_points(results_, axis_, CostAxis::kOperations);
  const auto paper = cheapest_within(of_paper(points, results_), limit_);
  return paper ? &results_[paper->result] : nullptr;
}

}  // namespace substep
