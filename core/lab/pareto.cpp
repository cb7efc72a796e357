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

std::optional<std::size_t> cheapest_within(std::span<const CostAndError> points, double error) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CostAndError& p = points[i];
    if (!(p.error <= error)) continue;
    if (!best || p.cost < points[*best].cost ||
        (p.cost == points[*best].cost && p.error < points[*best].error)) {
      best = i;
    }
  }
  return best;
}

}  // namespace substep
