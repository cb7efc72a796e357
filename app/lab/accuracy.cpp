#include "app/lab/accuracy.hpp"

#include <algorithm>
#include <chrono>

#include "app/lab/frame_slices.hpp"
#include "core/io/experiment.hpp"
#include "scenes/generator/sweeps.hpp"

namespace substep {
namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void Accuracy::begin(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  search_.reset();
  trial_.reset();
  sweep_.reset();
  shipped_.reset();
  cancelled_ = false;
  trade_is_of_.reset();
  trade_alpha = scene_->settings.alpha;
  trade_policy = scene_->settings.policy;
}

void Accuracy::start(std::shared_ptr<const Scene> scene) {
  begin(std::move(scene));
  paper_ = paper_settings(*scene_);
  sweep_.emplace(scene_, quick_sweep(*scene_), kWindowBudget);
  elapsed_ = 0.0;
  last_ = -1.0;
  if (!scene_->criteria.track) error = first_axis(*scene_);
  if (picture == AccuracyPicture::kStabilityMap && !has_map()) {
    picture = AccuracyPicture::kErrorAgainstCost;
  }
}

bool Accuracy::show_shipped(const std::shared_ptr<const Scene>& scene, bool asked) {
  if (shipped_ && scene_ == scene) return true;
  if (running() || (sweep_ && !asked) || (looked_up_ == scene && !asked)) return false;
  looked_up_ = scene;
  auto stored = read_sweep(scenes::sweep_of(scene->name), *scene);
  if (!stored) return false;
  begin(scene);
  shipped_ = std::move(stored);
  shipped_plan_.clear();
  for (const Result& result : shipped_->results) shipped_plan_.push_back(result.experiment);
  error = first_axis(*scene);
  cost = CostAxis::kOperations;
  if (const auto& recommended = scene->recommended) {
    error = recommended->of;
    wanted.at(static_cast<std::size_t>(error)) = recommended->within;
  }
  select_available_axes();
  return true;
}

void Accuracy::cancel() { cancelled_ = true; }

double Accuracy::slice(bool plays, double drawing) {
  constexpr double kSlow = 1.0 / 30.0;
  constexpr double kPause = 0.25;  // a longer pause: the tab was suspended
  const double most = drawing > kSlow ? std::min(drawing, kPause) : 0.0;
  return plays ? std::max(0.003, 0.2 * most) : std::max(0.008, 0.6 * most);
}

void Accuracy::advance(double seconds) {
  if (effects.running()) {
    effects.advance(seconds);
    return;
  }
  if (trying()) {
    trial_->advance(seconds);
    last_ = -1.0;  // the sweep is paused
    return;
  }
  if (searching()) {
    search_->advance(seconds);
    last_ = -1.0;  // the sweep is paused
    return;
  }
  if (!running()) return;
  const double now = wall_clock();
  if (last_ >= 0.0) elapsed_ += std::min(now - last_, 1.0);  // ignores suspended time
  last_ = now;
  sweep_->advance(seconds);
  if (!running()) select_available_axes();
}

void Accuracy::select_available_axes() {
  for (int i = 0; i < static_cast<int>(ErrorAxis::kCount) && !has(error); ++i) {
    if (has(static_cast<ErrorAxis>(i))) error = static_cast<ErrorAxis>(i);
  }
  // Without constraints most solvers have zero cost.
  const auto is_free = [this](const Result& r) { return cost_of(r, cost) == 0.0; };
  const auto n = static_cast<std::ptrdiff_t>(results().size());
  if (2 * std::count_if(results().begin(), results().end(), is_free) > n) {
    cost = CostAxis::kSubsteps;
  }
}

double Accuracy::progress() const { return sweep_ ? sweep_->progress() : 0.0; }

double Accuracy::seconds_left() const {
  const double share = progress();
  if (share < 0.02 || elapsed_ < 1.0) return -1.0;
  return elapsed_ * (1.0 - share) / share;
}

const std::vector<Result>& Accuracy::results() const {
  static const std::vector<Result> none;
  if (shipped_) return shipped_->results;
  return sweep_ ? sweep_->results() : none;
}

const std::vector<Experiment>& Accuracy::experiments() const {
  static const std::vector<Experiment> none;
  if (shipped_) return shipped_plan_;
  return sweep_ ? sweep_->experiments() : none;
}

bool Accuracy::has_map() const {
  return std::any_of(experiments().begin(), experiments().end(),
                     [](const Experiment& e) { return e.load != 1.0; });
}

const ReferenceSummary* Accuracy::reference() const {
  if (shipped_) return &shipped_->reference;
  return sweep_ ? sweep_->reference() : nullptr;
}

const FairTrade& Accuracy::trade() {
  const std::tuple key(results().size(), trade_alpha, trade_policy);
  if (trade_is_of_ != key) {
    trade_ = scene_ ? fair_trade(*scene_, results(), trade_policy, trade_alpha) : FairTrade{};
    trade_is_of_ = key;
  }
  return trade_;
}

double Accuracy::floor() const {
  return error == ErrorAxis::kTrajectory && reference() != nullptr ? reference()->uncertainty : 0.0;
}

std::vector<Accuracy::Point> Accuracy::points() const {
  return run_points(results(), error, cost, floor());
}

std::optional<Accuracy::Point> Accuracy::best(const std::vector<Point>& points) const {
  return error_is_given ? cheapest_within(points, limit().most)
                        : most_exact_within(points, limit().most);
}

Accuracy::Limit Accuracy::limit() const {
  const auto axis =
      error_is_given ? static_cast<std::size_t>(error) : static_cast<std::size_t>(cost);
  return {error_is_given, axis, error_is_given ? wanted.at(axis) : budget.at(axis)};
}

void Accuracy::search_alpha() {
  searched_for_ = limit();
  Experiment paper = experiment_of(*scene_, paper_);
  paper.duration = experiments().front().duration;
  search_.emplace(error_is_given
                      ? AlphaSearch::largest_within(scene_, paper, *sweep_->reference(), error,
                                                    searched_for_.most, kWindowBudget)
                      : AlphaSearch::smallest_within(scene_, paper, *sweep_->reference(), cost,
                                                     searched_for_.most, kWindowBudget));
}

const AlphaSearch* Accuracy::alpha_search() const {
  return search_ && searched_for_ == limit() ? &*search_ : nullptr;
}

bool Accuracy::can_promise() const {
  return error != ErrorAxis::kTrajectory ||
         kTimesAsCertain * floor() <= wanted.at(static_cast<std::size_t>(error));
}

void Accuracy::try_whole() {
  tried_for_ = limit();
  std::vector<Result> candidates;
  for (const Point& point :
       cheapest_first(run_points(results(), error, CostAxis::kOperations), tried_for_.most)) {
    candidates.push_back(results()[point.result]);
  }
  // The path was compared for as long as there is a reference.
  const auto serves = [axis = error, most = tried_for_.most](const Result& result) {
    const auto value = error_of(result, axis);
    return axis == ErrorAxis::kTrajectory || (value && *value <= most);
  };
  trial_.emplace(scene_, std::move(candidates), scene_->criteria.duration, no_reference(), serves,
                 kWindowBudget);
}

const HoldSearch* Accuracy::trial() const {
  return trial_ && tried_for_ == limit() ? &*trial_ : nullptr;
}

std::optional<Recommended> Accuracy::take_recommended() {
  if (!trial() || !trial_->found()) return std::nullopt;
  const Tried tried{scene_->criteria.duration, trial_->failed().size()};
  trial_.reset();
  return recommended_of(results(), error, tried_for_.most, tried);
}

std::vector<Accuracy::Point> Accuracy::failed() const {
  std::vector<Point> list;
  for (std::size_t i = 0; i < results().size(); ++i) {
    if (!results()[i].metrics.holds && results()[i].experiment.load == 1.0)
      list.push_back({cost_of(results()[i], cost), 0.0, i});
  }
  return list;
}

bool Accuracy::has(ErrorAxis axis) const {
  const auto measured = [axis](const Result& r) { return error_of(r, axis).value_or(0.0) > 0.0; };
  return std::count_if(results().begin(), results().end(), measured) > 1;
}

}  // namespace substep
