#include "core/lab/recommendation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <tuple>

#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

/// The next larger number of two digits.
double two_digits_up(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / digit - 1e-9) * digit;  // 1e-9: a number of two digits stays
}

/// The points with `bound` within the limit, by `aim`, then `bound`.
std::vector<RunPoint> least_first(std::span<const RunPoint> points, double RunPoint::*bound,
                                  double limit, double RunPoint::*aim) {
  std::vector<RunPoint> within;
  std::copy_if(points.begin(), points.end(), std::back_inserter(within),
               [&](const RunPoint& p) { return p.*bound <= limit; });
  std::stable_sort(within.begin(), within.end(), [&](const RunPoint& p, const RunPoint& q) {
    return std::tie(p.*aim, p.*bound) < std::tie(q.*aim, q.*bound);
  });
  return within;
}

std::optional<RunPoint> first(const std::vector<RunPoint>& points) {
  return points.empty() ? std::nullopt : std::optional(points.front());
}

bool is_paper(const Settings& s) {
  return s.solver == SolverKind::kBpp && s.integrator == Integrator::kEuler &&
         s.mode == Mode::kAdaptive && s.policy == Policy::kFrame && !s.islands &&
         s.contact_stiffness == ContactStiffness::kPaper && s.drift_order == 1;
}

/// "the paper's method takes 65 times the work, with alpha 0.00625."
std::string beside_paper(std::span<const RunPoint> points, std::span<const Result> results,
                         const RunPoint& best, double within) {
  const auto paper = cheapest_within(of_paper(points, results), within);
  if (!paper) return "no run of the paper's method reaches this error.";
  if (paper->result == best.result) return "it is the paper's method.";
  const double times = paper->cost / best.cost;
  return format_text("the paper's method takes %.*f times the work, with alpha %g.",
                     times < 10.0 ? 1 : 0, times, results[paper->result].experiment.settings.alpha);
}

/// " It holds for 10 s, 2 cheaper ones do not."
std::string held_text(const RunPoint& best, std::span<const Result> results, const Tried& tried) {
  if (tried.seconds <= results[best.result].experiment.duration) return "";
  std::string text = format_text(" It holds for %g s", tried.seconds);
  if (tried.failed == 1) text += ", a cheaper one does not";
  if (tried.failed > 1) text += format_text(", %zu cheaper ones do not", tried.failed);
  return text + ".";
}

/// "The cheapest of 348 runs, 267 of which hold; the paper's method takes 65 times the work, with
/// alpha 0.00625. It holds for 10 s, a cheaper one does not."
std::string reason(std::span<const RunPoint> points, std::span<const Result> results,
                   const RunPoint& best, double within, const Tried& tried) {
  const auto plain = [](const Result& r) { return r.experiment.load == 1.0; };
  const auto runs = std::count_if(results.begin(), results.end(), plain);
  const auto held = std::count_if(results.begin(), results.end(),
                                  [&](const Result& r) { return plain(r) && r.metrics.holds; });
  const std::string text = format_text("The cheapest of %lld runs, %lld of which hold; ",
                                       static_cast<long long>(runs), static_cast<long long>(held));
  return text + beside_paper(points, results, best, within) + held_text(best, results, tried);
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

std::vector<RunPoint> cheapest_first(std::span<const RunPoint> points, double error) {
  return least_first(points, &RunPoint::error, error, &RunPoint::cost);
}

std::vector<RunPoint> most_exact_first(std::span<const RunPoint> points, double cost) {
  return least_first(points, &RunPoint::cost, cost, &RunPoint::error);
}

std::optional<RunPoint> cheapest_within(std::span<const RunPoint> points, double error) {
  return first(cheapest_first(points, error));
}

std::optional<RunPoint> most_exact_within(std::span<const RunPoint> points, double cost) {
  return first(most_exact_first(points, cost));
}

double promise(const Reference& reference, double wanted) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!reference.failure.empty()) return kNone;
  const double least = kTimesAsCertain * reference.uncertainty;
  if (least <= wanted) return wanted;
  double travelled = 0.0;
  for (const Vec3& x : reference.track) {
    travelled = std::max(travelled, (x - reference.track.front()).norm());
  }
  return least < travelled ? two_digits_up(least) : kNone;
}

std::vector<RunPoint> of_paper(std::span<const RunPoint> points, std::span<const Result> results) {
  std::vector<RunPoint> own;
  std::copy_if(points.begin(), points.end(), std::back_inserter(own),
               [&](const RunPoint& p) { return is_paper(results[p.result].experiment.settings); });
  return own;
}

std::optional<Recommended> recommended_of(std::span<const Result> results, ErrorAxis of,
                                          double within, const Tried& tried) {
  const std::vector<RunPoint> points = run_points(results, of, CostAxis::kOperations);
  const std::vector<RunPoint> candidates = cheapest_first(points, within);
  if (tried.failed >= candidates.size()) return std::nullopt;
  const RunPoint& best = candidates[tried.failed];
  const Experiment& experiment = results[best.result].experiment;
  return Recommended{.settings = experiment.settings,
                     .of = of,
                     .within = within,
                     // Further digits depend on the compiler's libm.
                     .reached = std::min(within, three_digits(best.error)),
                     .operations = three_digits(best.cost),
                     .seconds = experiment.duration,
                     .why = reason(points, results, best, within, tried)};
}

}  // namespace substep
