#include "core/lab/pareto.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace substep {

std::vector<bool> pareto_front(std::span<const CostAndError> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost
                                            : points[a].error < points[b].error;
  });
  std::vector<bool> front(points.size(), false);
  double least = std::numeric_limits<double>::infinity();  // error of all cheaper points
  for (std::size_t i = 0; i < order.size();) {
    const CostAndError& best = points[order[i]];  // of its cost
    for (std::size_t same = i; same < order.size() && points[order[same]].cost == best.cost;
         ++same) {
      front[order[same]] = best.error < least && points[order[same]].error == best.error;
      i = same + 1;
    }
    least = std::min(least, best.error);
  }
  return front;
}

namespace {

/// The point with the smallest `aim`, then `bound`, among those with `bound` within the limit.
std::optional<std::size_t> least_within(std::span<const CostAndError> points,
                                        double CostAndError::*bound, double limit,
                                        double CostAndError::*aim) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CostAndError& p = points[i];
    if (!(p.*bound <= limit)) continue;
    if (!best || p.*aim < points[*best].*aim ||
        (p.*aim == points[*best].*aim && p.*bound < points[*best].*bound)) {
      best = i;
    }
  }
  return best;
}

}  // namespace

std::optional<std::size_t> cheapest_within(std::span<const CostAndError> points, double error) {
  return least_within(points, &CostAndError::error, error, &CostAndError::cost);
}

std::optional<std::size_t> most_exact_within(std::span<const CostAndError> points, double cost) {
  return least_within(points, &CostAndError::cost, cost, &CostAndError::error);
}

}  // namespace substep
