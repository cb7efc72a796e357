#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace substep {

struct CostAndError {
  double cost = 0.0;
  double error = 0.0;
};

/// Marks the points on the Pareto front: no other has less cost at no more error, or less error at
/// no more cost. Equal points are all marked. O(n log n).
std::vector<bool> pareto_front(std::span<const CostAndError> points);

/// The point of least cost whose error is no more than this; of equal costs the more exact one.
std::optional<std::size_t> cheapest_within(std::span<const CostAndError> points, double error);

/// The point of least error whose cost is no more than this; of equal errors the cheaper one.
std::optional<std::size_t> most_exact_within(std::span<const CostAndError> points, double cost);

}  // namespace substep
