#include "core/lab/recommendation.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>

#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

/// The point with the smallest `aim`, then `bound`, among those with `bound` within the limit.
std::optional<RunPoint> least_within(std::span<const RunPoint> points, double RunPoint::*bound,
                                     double limit, double RunPoint::*aim) {
  std::optional<RunPoint> best;
  for (const RunPoint& p : points) {
    if (!(p.*bound <= limit)) continue;
    if (!best || p.*aim < (*best).*aim || (p.*aim == (*best).*aim && p.*bound < (*best).*bound)) {
      best = p;
    }
  }
  return best;
}

bool is_paper(const Settings& s) {
  return s.solver == SolverKind::kBpp && s.integrator == Integrator::kEuler &&
         s.mode == Mode::kAdaptive && s.policy == Policy::kFrame && !s.islands &&
         s.contact_stiffness == ContactStiffness::kPaper && s.drift_order == 1;
}

/// "The cheapest of 348 runs, 267 of which hold; the paper's method takes 65 times the work, with
/// alpha 0.00625."
std::string reason(std::span<const RunPoint> points, std::span<const Result> results,
                   const RunPoint& best, double within) {
  const auto plain = [](const Result& r) { return r.experiment.load == 1.0; };
  const auto runs = std::count_if(results.begin(), results.end(), plain);
  const auto held = std::count_if(results.begin(), results.end(),
                                  [&](const Result& r) { return plain(r) && r.metrics.holds; });
  const std::string text = format_text("The cheapest of %lld runs, %lld of which hold; ",
                                       static_cast<long long>(runs), static_cast<long long>(held));
  const auto paper = cheapest_within(of_paper(points, results), within);
  if (!paper) return text + "no run of the paper's method reaches this error.";
  if (paper->result == best.result) return text + "it is the paper's method.";
  const double times = paper->cost / best.cost;
  return text + format_text("the paper's method takes %.*f times the work, with alpha %g.",
                            times < 10.0 ? 1 : 0, times,
                            results[paper->result].experiment.settings.alpha);
}

}  // namespace

void mark_front(std::span<RunPoint> points) {
  std::vector<RunPoint*> order;
  for (RunPoint& point : points) order.push_back(&point);
  std::sort(order.begin(), order.end(), [](const RunPoint* a, const RunPoint* b) {
    return std::tie(a->cost, a->error) < std::tie(b->cost, b->error);
  });
  const RunPoint* best = nullptr;  // of all cheaper points
  for (RunPoint* point : order) {
    const bool equals = best && point->cost == best->cost && point->error == best->error;
    point->front = !best || equals || point->error < best->error;
    if (point->front) best = point;
  }
}

std::vector<RunPoint> run_points(std::span<const Result> results, ErrorAxis error, CostAxis cost,
                                 double floor) {
  std::vector<RunPoint> points;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].experiment.load != 1.0) continue;  // on the map
    const auto value = error_of(results[i], error);
    const double price = cost_of(results[i], cost);
    if (!value || !(*value > 0.0) || !(price > 0.0)) continue;
    points.push_back({price, std::max(*value, floor), i});
  }
  mark_front(points);
  return points;
}

std::optional<RunPoint> cheapest_within(std::span<const RunPoint> points, double error) {
  return least_within(points, &RunPoint::error, error, &RunPoint::cost);
}

std::optional<RunPoint> most_exact_within(std::span<const RunPoint> points, double cost) {
  return least_within(points, &RunPoint::cost, cost, &RunPoint::error);
}

std::vector<RunPoint> of_paper(std::span<const RunPoint> points, std::span<const Result> results) {
  std::vector<RunPoint> own;
  std::copy_if(points.begin(), points.end(), std::back_inserter(own),
               [&](const RunPoint& p) { return is_paper(results[p.result].experiment.settings); });
  return own;
}

std::optional<Recommended> recommended_of(std::span<const Result> results, ErrorAxis of,
                                          double within) {
  const std::vector<RunPoint> points = run_points(results, of, CostAxis::kOperations);
  const auto best = cheapest_within(points, within);
  if (!best) return std::nullopt;
  const Experiment& experiment = results[best->result].experiment;
  return Recommended{.settings = experiment.settings,
                     .of = of,
                     .within = within,
                     // Further digits depend on the compiler's libm.
                     .reached = std::min(within, three_digits(best->error)),
                     .operations = three_digits(best->cost),
                     .seconds = experiment.duration,
                     .why = reason(points, results, *best, within)};
}

}  // namespace substep
