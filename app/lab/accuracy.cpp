#include "app/lab/accuracy.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "app/lab/frame_slices.hpp"
#include "core/io/experiment.hpp"

namespace substep {
namespace {

/// The curves grow evenly when every fourth value comes first, then every second, then the rest;
/// the map of loads comes last.
constexpr int kMapRound = 3;
int round_of(std::size_t along_curve) {
  if (along_curve % 4 == 0) return 0;
  return along_curve % 2 == 0 ? 1 : 2;
}

std::vector<Experiment> plan(const Scene& scene) {
  struct Step {
    int round;
    Experiment experiment;
  };
  Experiment plain = experiment_of(scene, scene.settings);
  // Beyond its window a motion cannot be foretold, and people wait.
  plain.duration = predictable_window(scene, scene.criteria.duration);
  std::vector<Step> steps;
  std::map<std::string, std::size_t> along;
  for (const SweepPoint& point : default_sweep(scene)) {
    const int round =
        point.load == 1.0 ? round_of(along[series_name(point.settings)]++) : kMapRound;
    Step& step = steps.emplace_back(Step{round, plain});
    step.experiment.settings = point.settings;
    step.experiment.load = point.load;
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const Step& a, const Step& b) { return a.round < b.round; });
  std::vector<Experiment> experiments;
  for (Step& step : steps) experiments.push_back(std::move(step.experiment));
  return experiments;
}

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void Accuracy::start(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  search_.reset();
  paper_ = paper_settings(*scene_);
  sweep_.emplace(scene_, plan(*scene_), kWindowBudget);
  cancelled_ = false;
  elapsed_ = 0.0;
  last_ = -1.0;
  if (!scene_->criteria.track) error = first_axis(*scene_);
  if (picture == AccuracyPicture::kStabilityMap && !has_map()) {
    picture = AccuracyPicture::kErrorAgainstCost;
  }
}

void Accuracy::cancel() { cancelled_ = true; }

double Accuracy::slice(bool plays, double drawing) {
  constexpr double kSlow = 1.0 / 30.0;
  constexpr double kPause = 0.25;  // a tab that slept was not drawing
  const double most = drawing > kSlow ? std::min(drawing, kPause) : 0.0;
  return plays ? std::max(0.003, 0.2 * most) : std::max(0.008, 0.6 * most);
}

void Accuracy::advance(double seconds) {
  if (effects.running()) {
    effects.advance(seconds);
    return;
  }
  if (searching()) {
    search_->advance(seconds);
    last_ = -1.0;  // the sweep waits
    return;
  }
  if (!running()) return;
  const double now = wall_clock();
  if (last_ >= 0.0) elapsed_ += std::min(now - last_, 1.0);  // a tab that slept was not at work
  last_ = now;
  sweep_->advance(seconds);
  if (!running()) look_at_what_there_is();
}

void Accuracy::look_at_what_there_is() {
  for (int i = 0; i < static_cast<int>(ErrorAxis::kCount) && !has(error); ++i) {
    if (has(static_cast<ErrorAxis>(i))) error = static_cast<ErrorAxis>(i);
  }
  // Where nothing constrains, most solvers have nothing to do.
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
  return sweep_ ? sweep_->results() : none;
}

const std::vector<Experiment>& Accuracy::experiments() const {
  static const std::vector<Experiment> none;
  return sweep_ ? sweep_->experiments() : none;
}

bool Accuracy::has_map() const {
  return std::any_of(experiments().begin(), experiments().end(),
                     [](const Experiment& e) { return e.load != 1.0; });
}

const Reference* Accuracy::reference() const { return sweep_ ? sweep_->reference() : nullptr; }

std::vector<Accuracy::Point> Accuracy::points() const { return run_points(results(), error, cost); }

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
  search_.emplace(error_is_given ? AlphaSearch::largest_within(scene_, paper, *reference(), error,
                                                               searched_for_.most, kWindowBudget)
                                 : AlphaSearch::smallest_within(scene_, paper, *reference(), cost,
                                                                searched_for_.most, kWindowBudget));
}

const AlphaSearch* Accuracy::alpha_search() const {
  return search_ && searched_for_ == limit() ? &*search_ : nullptr;
}

std::vector<Accuracy::Point> Accuracy::failed() const {
  std::vector<Point> list;
  for (std::size_t i = 0; i < results().size(); ++i) {
    if (!results()[i].metrics.holds && results()[i].experiment.load == 1.0)
      list.push_back({{cost_of(results()[i], cost), 0.0}, i});
  }
  return list;
}

bool Accuracy::has(ErrorAxis axis) const {
  const auto measured = [axis](const Result& r) { return error_of(r, axis).value_or(0.0) > 0.0; };
  return std::count_if(results().begin(), results().end(), measured) > 1;
}

}  // namespace substep
