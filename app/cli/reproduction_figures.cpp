// Figs. 2, 3 and 4 of the paper.

#include <cmath>

#include "app/cli/cancel.hpp"
#include "app/cli/reproduction.hpp"
#include "app/cli/reproduction_runs.hpp"
#include "core/model/format_text.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

using Outcome = Card::Outcome;

Curve substeps_curve(const std::string& name, const RunTrace& trace) {
  Curve curve{name, {}, by_frame(trace), trace.holds ? "" : trace.verdict, !trace.holds};
  if (!trace.time.empty()) curve.x.assign(trace.time.begin() + 1, trace.time.end());
  curve.step = true;
  return curve;
}

/// A picture of Fig. 2: adaptive, and the smallest constant N with no larger error.
struct Figure2 {
  int n = 0;            // of the constant run, 0 if none was small enough
  double fewer = 0.0;   // share of sub-steps that adaptive saves [-]
  double median = 0.0;  // N of adaptive
  double least = 0.0;
  double most = 0.0;
  bool holds = false;
  Json chart;
};

Figure2 figure_2(const std::string& title, const std::shared_ptr<const Scene>& scene,
                 Settings settings, std::vector<double> RunTrace::*error, int jobs) {
  constexpr int kMost = 40;
  const double seconds = scene->criteria.duration;
  std::vector<Run> runs{{"adaptive, alpha 0.1", scene, settings, seconds}};
  settings.mode = Mode::kConst;
  for (settings.n = 1; settings.n <= kMost; ++settings.n) {
    runs.push_back({format_text("constant %d", settings.n), scene, settings, seconds});
  }
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  const RunTrace& adaptive = traces.front();
  const double limit = peak(adaptive.*error);
  Figure2 figure;
  figure.holds = adaptive.holds;
  figure.least = quantile(by_frame(adaptive), 0.0);
  figure.median = quantile(by_frame(adaptive), 0.5);
  figure.most = peak(by_frame(adaptive));
  for (int n = kMost; n >= 1; --n) {  // downwards: an error may drop below the limit by chance
    const RunTrace& constant = traces[static_cast<std::size_t>(n)];
    if (!constant.holds || peak(constant.*error) > limit) break;
    figure.n = n;
  }
  std::vector<Curve> curves{substeps_curve(runs.front().name, adaptive)};
  if (figure.n > 0) {
    const auto at = static_cast<std::size_t>(figure.n);
    figure.fewer = 1.0 - adaptive.total_substeps() / traces[at].total_substeps();
    curves.push_back(substeps_curve(runs[at].name, traces[at]));
    curves.back().dashed = true;
  }
  figure.chart = chart_json(title, "", "time [s]", "sub-steps per frame", false, curves);
  return figure;
}

std::string described(const Figure2& f) {
  std::string words = format_text("%g / %g / %g sub-steps per frame (least, median, most)", f.least,
                                  f.median, f.most);
  if (f.n == 0) return words + ", with a smaller error than every constant number up to 40";
  return words + format_text(", %.0f %% %s than the constant %d with no larger error",
                             100.0 * std::abs(f.fewer), f.fewer >= 0.0 ? "fewer" : "more", f.n);
}

/// The largest energy of each swing: the swings themselves would be a solid band.
Curve largest_of_swings(const std::string& name, const RunTrace& trace) {
  constexpr double kLeast = 500.0;  // [J]
  Curve curve{name, {}, {}, trace.holds ? "" : trace.verdict, !trace.holds};
  const std::vector<double>& kinetic = trace.kinetic;
  for (std::size_t k = 1; k + 1 < kinetic.size(); ++k) {
    if (kinetic[k] < kinetic[k - 1] || kinetic[k] < kinetic[k + 1] || kinetic[k] < kLeast) continue;
    curve.x.push_back(trace.time[k]);
    curve.y.push_back(kinetic[k]);
  }
  if (!trace.holds) {
    curve.x.push_back(trace.time.back());
    curve.y.push_back(kinetic.back());
  }
  return curve;
}

}  // namespace

Card substeps_over_time(int jobs) {
  Card card;
  card.title = "Fig. 2: sub-steps over time";
  card.paper =
      "The number of sub-steps follows the stiffness: most at the bottom of the swing, and while "
      "the ball is on the bridge. A constant number must be sufficient for the worst frame.";
  const auto box = shared(scenes::swinging_box());
  Scene short_bridge = scenes::bridge();
  short_bridge.criteria.duration = 6.0;
  const Figure2 swing = figure_2("Swinging box, direct solver", box, direct(Mode::kAdaptive),
                                 &RunTrace::constraint_error, jobs);
  const Figure2 gauss = figure_2("Swinging box, Gauss-Seidel with 25 iterations", box,
                                 pgs(Mode::kAdaptive), &RunTrace::constraint_error, jobs);
  const Figure2 crossing = figure_2("Bridge, direct solver", shared(short_bridge),
                                    direct(Mode::kAdaptive), &RunTrace::joint_gap, jobs);
  card.here = "Swinging box: " + described(swing) + ". With Gauss-Seidel: " + described(gauss) +
              ". Bridge: " + described(crossing) + ".";
  card.why =
      "The saving depends on the constant number. Compared with the one that has the same largest "
      "error as adaptive, as here, adaptive saves sub-steps; compared with the smallest that holds "
      "(7 on the swinging box) it does not, but only trial gives that "
      "number.";
  card.command = "substep run swinging_box --csv -";
  const bool follows = swing.holds && gauss.holds && crossing.holds &&
                       swing.most > 1.5 * swing.least && crossing.most > 3.0 * crossing.least;
  card.outcome = follows ? Outcome::kAgrees : Outcome::kFails;
  card.charts = {swing.chart, gauss.chart, crossing.chart};
  return card;
}

Card energy_over_time(int jobs) {
  constexpr double kSeconds = 200.0;
  Card card;
  card.title = "Fig. 3: kinetic energy over 200 s";
  card.paper = "Adaptive damping slows the swing down; adaptive sub-steps keep its energy.";
  const auto scene = shared(scenes::swinging_box());
  Settings leapfrog = direct(Mode::kAdaptive);
  leapfrog.integrator = Integrator::kLeapfrog;
  const std::vector<Run> runs{{"adaptive, alpha 0.1", scene, direct(Mode::kAdaptive), kSeconds},
                              {"adaptive with leapfrog", scene, leapfrog, kSeconds},
                              {"damping", scene, direct(Mode::kDamping), kSeconds},
                              {"none", scene, direct(Mode::kNone), kSeconds}};
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  if (cancel_on_signal()) return card;
  const double adaptive = energy_change(*scene, traces[0]);
  const double second_order = energy_change(*scene, traces[1]);
  const double damping = energy_change(*scene, traces[2]);
  card.here = format_text(
      "After 200 s damping has lost %.1f %% of the exchanged energy, adaptive sub-steps %.1f %%; "
      "with leapfrog, at the same cost, the energy has changed by %.1g %%. "
      "Without either the chain %s.",
      -damping, -adaptive, second_order, life(traces[3]).c_str());
  card.why =
      "The small loss of adaptive sub-steps is due to changes of the step with semi-implicit "
      "Euler, whose velocities lag half a step behind. Leapfrog has no such lag.";
  card.command = "substep run swinging_box --seconds 200 --mode damping";
  const bool as_before = traces[0].holds && traces[2].holds && std::abs(damping + 97.8) < 4.9 &&
                         std::abs(adaptive + 2.8) < 0.14 && std::abs(second_order) < 1e-3;
  card.outcome = as_before ? Outcome::kAgrees : Outcome::kFails;
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    curves.push_back(largest_of_swings(runs[i].name, traces[i]));
  }
  card.charts = {chart_json("Largest kinetic energy of every swing", "", "time [s]",
                            "kinetic energy [J]", false, curves)};
  return card;
}

Card heavy_stack(int jobs) {
  constexpr double kSeconds = 10.0;
  Card card;
  card.title = "Fig. 4: heavy stack by solver and mode";
  card.paper = "Only adaptive sub-steps with the direct solver keep the stack standing.";
  std::vector<Run> runs;
  for (const auto& scene : {shared(scenes::heavy_stack_stress()), shared(scenes::heavy_stack())}) {
    const auto add = [&](const char* name, const Settings& settings) {
      runs.push_back({name, scene, settings, kSeconds});
    };
    add("none", direct(Mode::kNone));
    add("damping", direct(Mode::kDamping));
    add("const 4", direct(Mode::kConst, 4));
    add("const 8", direct(Mode::kConst, 8));
    add("adaptive", direct(Mode::kAdaptive));
    add("adaptive, Gauss-Seidel 25", pgs(Mode::kAdaptive));
    add("adaptive, Gauss-Seidel 200", pgs(Mode::kAdaptive, Drift::kAuto, 200));
  }
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  const std::size_t cases = runs.size() / 2;  // the stress stack first
  bool direct_stands = true;
  bool gauss_falls = true;
  bool pattern = true;
  for (std::size_t i = 0; i < cases; ++i) {
    const bool exact_holds = traces[cases + i].holds;
    const bool is_pgs = runs[i].settings.solver == SolverKind::kPgs;
    (is_pgs ? gauss_falls : direct_stands) &= is_pgs ? !exact_holds : exact_holds;
    pattern &= traces[i].holds == (runs[i].settings.mode == Mode::kAdaptive && !is_pgs);
  }
  card.here =
      "With displaced balls and a regularisation that models finite precision "
      "(heavy_stack_stress): " +
      lives(runs, traces, 0, cases) +
      ". In double precision: " + lives(runs, traces, cases, cases) + ".";
  card.why =
      "In exact arithmetic the constrained stiffness of the symmetric stack is zero, so it does "
      "not fall. It falls because of finite precision or compliance, which a smaller step does not "
      "reduce. In double precision it stands in every direct mode, even with a single step; with a "
      "stated imprecision the paper's pattern appears.";
  card.command = "substep run heavy_stack_stress --mode const --n 8";
  card.outcome = !(pattern && gauss_falls) ? Outcome::kFails
                 : direct_stands           ? Outcome::kDiffers
                                           : Outcome::kAgrees;
  runs.resize(cases);
  card.charts = {chart_json("Height of the heavy box, heavy_stack_stress", "", "time [s]",
                            "height of its centre [m]", false,
                            curves_of(runs, traces, &RunTrace::height))};
  return card;
}

}  // namespace substep::cli
