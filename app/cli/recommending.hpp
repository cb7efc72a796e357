#pragma once
// What `recommend` does before it prints: the reference, the compared runs, and the runs of the
// whole duration.

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/lab/axes.hpp"
#include "core/lab/hold_search.hpp"
#include "core/lab/recommendation.hpp"

namespace substep::cli {

/// The given limit and the quantity to minimise.
struct Want {
  ErrorAxis error = ErrorAxis::kTrajectory;
  CostAxis cost = CostAxis::kOperations;
  bool error_is_given = true;
  double limit = 1e-3;

  [[nodiscard]] bool of_path() const { return error == ErrorAxis::kTrajectory; }
  /// The runs that meet the limit, the best first.
  [[nodiscard]] std::vector<RunPoint> best_first(std::span<const RunPoint> points) const {
    return error_is_given ? cheapest_first(points, limit) : most_exact_first(points, limit);
  }
  [[nodiscard]] bool is_met(const Result& result) const {
    if (!error_is_given) return cost_of(result, cost) <= limit;
    const auto value = error_of(result, error);
    return value && *value <= limit;
  }
  /// Of the reference [m].
  [[nodiscard]] double required() const {
    return error_is_given ? limit / kTimesAsCertain : std::numeric_limits<double>::infinity();
  }
};

/// A scene, what is wanted of it, and for how long it is run.
struct Question {
  std::shared_ptr<const Scene> scene;
  Want want;
  double compared = 0.0;  // duration of the compared runs [s]
  double whole = 0.0;     // for which the recommended run must hold [s]
  int jobs = 1;
  bool defaults = true;  // compares the default settings, too
};

/// The runs that were compared, and the first that serves for the whole duration.
struct Answer {
  Reference reference;
  std::vector<Result> results;
  std::vector<Result> candidates;  // that meet the limit, the best first
  std::vector<Result> failed;      // the first of these, run for the whole duration
  std::optional<std::size_t> found;
  std::optional<Result> nearest;  // to the limit, of all runs that hold

  [[nodiscard]] const Result* best() const { return found ? &candidates[*found] : nullptr; }
};

/// With progress on a terminal. @return empty if cancelled
std::optional<Reference> reference_for(const Question& question);
std::optional<Answer> answer_to(const Question& question, Reference reference);
/// Runs candidates for the whole duration until one serves.
std::optional<HoldSearch> searched(const Question& question, std::vector<Result> candidates,
                                   const Reference& reference);

}  // namespace substep::cli
