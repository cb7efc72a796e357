#include "core/lab/recommendation.hpp"

#include <algorithm>
#include <iterator>

namespace substep {
namespace {

std::vector<CostAndError> values_of(std::span<const RunPoint> points) {
  return {points.begin(), points.end()};
}

std::optional<RunPoint> at(std::span<const RunPoint> points, std::optional<std::size_t> index) {
  return index ? std::optional(points[*index]) : std::nullopt;
}

bool is_paper(const Settings& s) {
  return s.solver == SolverKind::kBpp && s.integrator == Integrator::kEuler &&
         s.mode == Mode::kAdaptive && s.policy == Policy::kFrame;
}

}  // namespace

std::vector<RunPoint> run_points(std::span<const Result> results, ErrorAxis error, CostAxis cost) {
  std::vector<RunPoint> points;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].experiment.load != 1.0) continue;  // on the map
    const auto value = error_of(results[i], error);
    const double price = cost_of(results[i], cost);
    if (!value || !(*value > 0.0) || !(price > 0.0)) continue;
    points.push_back({{price, *value}, i});
  }
  const std::vector<bool> front = pareto_front(values_of(points));
  for (std::size_t i = 0; i < points.size(); ++i) points[i].front = front[i];
  return points;
}

std::optional<RunPoint> cheapest_within(std::span<const RunPoint> points, double error) {
  return at(points, cheapest_within(std::span<const CostAndError>(values_of(points)), error));
}

std::optional<RunPoint> most_exact_within(std::span<const RunPoint> points, double cost) {
  return at(points, most_exact_within(std::span<const CostAndError>(values_of(points)), cost));
}

std::vector<RunPoint> of_paper(std::span<const RunPoint> points, std::span<const Result> results) {
  std::vector<RunPoint> own;
  std::copy_if(points.begin(), points.end(), std::back_inserter(own),
               [&](const RunPoint& p) { return is_paper(results[p.result].experiment.settings); });
  return own;
}

}  // namespace substep
