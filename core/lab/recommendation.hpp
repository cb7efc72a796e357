#pragma once
// What to set, from the runs of a sweep: arithmetic, and nothing that a person could not check in
// its picture.

#include <optional>
#include <span>
#include <vector>

#include "core/lab/axes.hpp"
#include "core/lab/pareto.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// A run that holds, in a picture of error against cost.
struct RunPoint : CostAndError {
  std::size_t result = 0;  // index into the results
  bool front = false;      // no other beats it
};

/// The runs of the scene as it stands that hold, with a positive error and cost.
/// @param floor errors below it are not measured, and count as this
std::vector<RunPoint> run_points(std::span<const Result> results, ErrorAxis error, CostAxis cost,
                                 double floor = 0.0);

/// The cheapest whose error is no more than this, and the other way around.
std::optional<RunPoint> cheapest_within(std::span<const RunPoint> points, double error);
std::optional<RunPoint> most_exact_within(std::span<const RunPoint> points, double cost);

/// Those of the paper's method: the direct solver, Euler, N decided once a frame, contacts in K as
/// it has them. The cheapest of them within an error has the largest alpha that does, the most
/// exact within a cost the smallest.
std::vector<RunPoint> of_paper(std::span<const RunPoint> points, std::span<const Result> results);

/// What a scene keeps of its sweep: the run of fewest solver operations within an error, and how it
/// stands beside the others, in three digits. Nothing where no run is within it.
/// @param results of one scene and of one length; the error in m or J
std::optional<Recommended> recommended_of(std::span<const Result> results, ErrorAxis of,
                                          double within);

}  // namespace substep
