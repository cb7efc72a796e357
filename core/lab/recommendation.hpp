#pragma once
// Recommends settings from the runs of a sweep, by rules that can be checked in its plot.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/lab/axes.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// A run that holds, as a point in the plot of error against cost.
struct RunPoint {
  double cost = 0.0;
  double error = 0.0;
  std::size_t result = 0;  // index into the results
  bool front = false;      // on the Pareto front
};

/// Marks the points on the Pareto front: no other has less cost at no more error, or less error at
/// no more cost. Equal points are all marked. O(n log n).
void mark_front(std::span<RunPoint> points);

/// The runs of the unmodified scene that hold, with positive error and cost. @param floor lower
/// bound: smaller errors are set to it
std::vector<RunPoint> run_points(std::span<const Result> results, ErrorAxis error, CostAxis cost,
                                 double floor = 0.0);

/// The runs whose error is no more than this, by cost; of equal costs the more exact one first.
std::vector<RunPoint> cheapest_first(std::span<const RunPoint> points, double error);
/// The runs whose cost is no more than this, by error; of equal errors the cheaper one first.
std::vector<RunPoint> most_exact_first(std::span<const RunPoint> points, double cost);
/// The first of these.
std::optional<RunPoint> cheapest_within(std::span<const RunPoint> points, double error);
std::optional<RunPoint> most_exact_within(std::span<const RunPoint> points, double cost);

/// A reference must be so many times as certain as an error that is promised against it.
inline constexpr double kTimesAsCertain = 10.0;
/// The error of the path that can be promised against a reference instead of the wanted one [m]:
/// this one if the reference is certain enough, else a larger one of two digits. Infinite if the
/// run of the reference fails, or if the error would be no less than the motion itself.
double promise(const Reference& reference, double wanted);

/// The runs of the paper's method: the direct solver, Euler, N decided once per frame, the paper's
/// contact stiffness. The cheapest within an error has the largest sufficient alpha, the most
/// accurate within a cost the smallest.
std::vector<RunPoint> of_paper(std::span<const RunPoint> points, std::span<const Result> results);

/// How long a recommended run was tried.
struct Tried {
  double seconds = 0.0;    // for which it holds [s]
  std::size_t failed = 0;  // cheaper runs within the error that do not
};

/// The recommendation that a scene stores: the run with the fewest solver operations within an
/// error, and its comparison with the other runs, in three digits. Nothing if no run is within the
/// error.
/// @param results of one scene and of one length; the error in m or J
/// @param tried if the runs were tried for longer: those that failed are passed over
std::optional<Recommended> recommended_of(std::span<const Result> results, ErrorAxis of,
                                          double within, const Tried& tried = {});

}  // namespace substep
