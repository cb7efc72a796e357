#include "app/ui/accuracy_curves.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

#include "app/text/format.hpp"
#include "core/model/methods.hpp"

namespace substep::ui {
namespace {

using Point = Accuracy::Point;

constexpr std::size_t kHeadlines = 5;

/// A headline curve, with a short name for its label in the picture.
struct Kind {
  const char* name;
  SolverKind solver;
  Mode mode;
  Integrator integrator;
  Tint tint;
};
constexpr std::array<Kind, 7> kKinds{
    {{"Constant N", SolverKind::kBpp, Mode::kConst, Integrator::kEuler, Tint::kBlue},
     {"Adaptive", SolverKind::kBpp, Mode::kAdaptive, Integrator::kEuler, Tint::kOrange},
     {"Störmer", SolverKind::kBpp, Mode::kAdaptive, Integrator::kStormer, Tint::kPurple},
     {"Leapfrog", SolverKind::kBpp, Mode::kAdaptive, Integrator::kLeapfrog, Tint::kTeal},
     {"Newton", SolverKind::kNewton, Mode::kConst, Integrator::kLeapfrog, Tint::kAmber},
     {"PGS", SolverKind::kPgs, Mode::kConst, Integrator::kEuler, Tint::kDim},
     {"XPBD", SolverKind::kXpbd, Mode::kConst, Integrator::kEuler, Tint::kDim}}};

/// Without the parameters that have separate curves.
bool is_plain(const Settings& s) {
  return s.policy == Policy::kFrame && !s.islands && s.drift_order == 1 && s.refinements == 0 &&
         s.contact_stiffness == ContactStiffness::kPaper && !s.share_iterations &&
         s.gyroscopic == Gyroscopic::kImplicit && s.forces != Forces::kNumerov;
}

bool is_of(const Kind& kind, const Settings& s) {
  return is_plain(s) && s.solver == kind.solver && s.mode == kind.mode &&
         s.integrator == kind.integrator && (!reads(s, "iterations") || s.iterations > 2);
}

const Settings& settings_of(const Accuracy& accuracy, const Point& point) {
  return accuracy.results()[point.result].experiment.settings;
}

void choose_headlines(const Theme& theme, const Accuracy& accuracy,
                      const std::vector<Point>& points, std::vector<AccuracyCurve>& curves) {
  std::size_t chosen = 0;
  for (const Kind& kind : kKinds) {
    if (chosen + 1 == kHeadlines) break;  // the last place is reserved for the best
    const auto found = std::find_if(curves.begin(), curves.end(), [&](const AccuracyCurve& c) {
      return c.points.size() > 1 && is_of(kind, settings_of(accuracy, c.points.front()));
    });
    if (found == curves.end()) continue;
    found->headline = true;
    found->name = kind.name;
    if (!accuracy.all_methods) found->style.color = color_of(theme, kind.tint);
    ++chosen;
  }
  const auto best = accuracy.best(points);
  if (!best) return;
  const std::string series = series_name(settings_of(accuracy, *best));
  for (AccuracyCurve& curve : curves) {
    if (curve.series != series || curve.headline) continue;
    curve.headline = true;
    curve.name = accuracy.error_is_given ? "Cheapest" : "Most accurate";
    if (!accuracy.all_methods) curve.style.color = theme.text;
  }
}

/// The cheapest or most accurate run of constant N with the direct solver and Euler, the usual
/// method.
std::optional<Point> plain_best(const Accuracy& accuracy, const std::vector<Point>& points) {
  std::vector<Point> plain;
  std::copy_if(points.begin(), points.end(), std::back_inserter(plain),
               [&](const Point& p) { return is_of(kKinds.front(), settings_of(accuracy, p)); });
  return accuracy.best(plain);
}

constexpr std::array<const char*, static_cast<std::size_t>(ErrorAxis::kCount)> kKept{
    "the path", "the energy", "joint gaps", "overlaps"};
constexpr std::array<const char*, static_cast<std::size_t>(CostAxis::kCount)> kFewer{
    "fewer sub-steps", "fewer operations", "less time"};

/// "capped + damping, leapfrog (N cap = 2)", within a sentence.
std::string with_parameter(const Settings& s) {
  std::string name = short_name(s);
  if (s.solver == SolverKind::kBpp) {  // else it begins with a proper name
    name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
  }
  return name + " (" + parameter_text(s) + ")";
}

/// "4.1 times", or "" if the ratio is negligible.
std::string times(double ratio) { return ratio < 1.05 ? "" : coarse_number(ratio) + " times "; }

}  // namespace

std::string error_text(double error, ErrorAxis axis) {
  const Unit unit = unit_for(error);
  return plain_number(error / unit.factor) + " " + unit.prefix +
         (axis == ErrorAxis::kEnergy ? "J" : "m");
}

std::string limit_text(const Accuracy& accuracy) {
  if (accuracy.error_is_given) {
    return error_text(accuracy.wanted.at(static_cast<std::size_t>(accuracy.error)), accuracy.error);
  }
  return cost_text(accuracy.budget.at(static_cast<std::size_t>(accuracy.cost)), accuracy.cost);
}

std::string cost_text(double cost, CostAxis axis) {
  switch (axis) {
    case CostAxis::kSubsteps:
      return short_number(cost) + " sub-steps per frame";
    case CostAxis::kOperations:
      return short_number(cost) + " operations per frame";
    default:
      return duration(1e-3 * cost) + " per frame";
  }
}

std::string short_name(const Settings& s) {
  const SolverEntry& solver = entry_of(s.solver);
  std::string name = curve_style(dark_theme(), s).own_name;
  if (!solver.at_end && s.integrator != Integrator::kEuler) {
    name += std::string(", ") + entry_of(s.integrator).title;
  }
  if (s.solver != SolverKind::kBpp) {
    return std::string(solver.title) + (name.empty() ? "" : ", ") + name;
  }
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

std::vector<AccuracyCurve> curves_of(const Theme& theme, const Accuracy& accuracy,
                                     const std::vector<Point>& points) {
  std::map<std::string, std::vector<Point>> by_series;
  for (const Point& p : points) by_series[series_name(settings_of(accuracy, p))].push_back(p);
  std::vector<AccuracyCurve> curves;
  for (auto& [series, own] : by_series) {
    const auto parameter = [&](const Point& p) {
      return series_parameter(settings_of(accuracy, p)).value;
    };
    std::sort(own.begin(), own.end(),
              [&](const Point& a, const Point& b) { return parameter(a) < parameter(b); });
    const Settings& s = settings_of(accuracy, own.front());
    curves.push_back({series, std::move(own), curve_style(theme, s), short_name(s)});
  }
  choose_headlines(theme, accuracy, points, curves);
  return curves;
}

std::string conclusion(const Accuracy& accuracy, const std::vector<Point>& points) {
  if (points.size() < 2) return "";
  const bool error_given = accuracy.error_is_given;
  const std::string limit =
      (error_given ? "To keep " + std::string(kKept.at(static_cast<std::size_t>(accuracy.error))) +
                         " within "
                   : "Within ") +
      limit_text(accuracy);
  const auto best = accuracy.best(points);
  if (!best) return limit + ", no tested method is enough.";
  const auto plain = plain_best(accuracy, points);
  const std::string name = with_parameter(settings_of(accuracy, *best));
  const std::string verdict =
      limit + ", " + name + (error_given ? " is the cheapest" : " has the smallest error");
  if (!plain) return verdict + "; no tested constant N with Euler is within the limit.";
  if (plain->result == best->result) return verdict + ".";
  const std::string ratio =
      times(error_given ? plain->cost / best->cost : plain->error / best->error);
  if (ratio.empty()) return verdict + "; constant N with Euler is as good.";
  return verdict + ": " + ratio +
         (error_given ? kFewer.at(static_cast<std::size_t>(accuracy.cost)) : "more accurate") +
         " than constant N with Euler.";
}

}  // namespace substep::ui
