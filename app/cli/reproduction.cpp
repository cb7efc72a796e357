#include "app/cli/reproduction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <thread>

#include "app/cli/report.hpp"
#include "app/cli/run_trace.hpp"
#include "core/io/number_text.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

using Outcome = Card::Outcome;

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* pattern, ...) {
  char buffer[1000];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, values);
  va_end(values);
  return buffer;
}

struct Run {
  std::shared_ptr<const Scene> scene;
  Settings settings;
  double seconds;  // [s]
};

/// All runs, on as many threads, in their order.
std::vector<RunTrace> trace_all(const std::vector<Run>& runs, const Reproduction& options) {
  std::vector<RunTrace> traces(runs.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < runs.size() && !*options.cancelled; i = next++) {
      traces[i] = trace_run(runs[i].scene, runs[i].settings, runs[i].seconds);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < options.jobs; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return traces;
}

std::shared_ptr<const Scene> shared(Scene scene) {
  return std::make_shared<const Scene>(std::move(scene));
}

Settings direct(Mode mode, int n = 16, double alpha = 0.1) {
  Settings settings;
  settings.mode = n == 1 && mode == Mode::kConst ? Mode::kNone : mode;
  settings.n = n;
  settings.alpha = alpha;
  return settings;
}
Settings pgs(Mode mode, Drift drift = Drift::kAuto, int iterations = 25) {
  Settings settings = direct(mode);
  settings.solver = SolverKind::kPgs;
  settings.iterations = iterations;
  settings.drift = drift;
  return settings;
}

double peak(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}
/// Sub-steps of the frames; the start has none.
std::vector<double> by_frame(const RunTrace& trace) {
  if (trace.substeps.empty()) return {};
  return {trace.substeps.begin() + 1, trace.substeps.end()};
}
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}
std::string life(const RunTrace& trace) {
  return trace.holds ? "holds" : text("fails at %.2f s", trace.failed_at);
}

Curve substeps_curve(const std::string& name, const RunTrace& trace) {
  Curve curve{name, {}, by_frame(trace), trace.holds ? "" : trace.verdict, !trace.holds};
  if (!trace.time.empty()) curve.x.assign(trace.time.begin() + 1, trace.time.end());
  curve.step = true;
  return curve;
}

/// A picture of Fig. 2: adaptive, and the smallest constant N that keeps as small an error.
struct Figure2 {
  int n = 0;            // of the constant run, 0 where none was small enough
  double fewer = 0.0;   // share of sub-steps that adaptive saves [-]
  double median = 0.0;  // N of adaptive
  double least = 0.0;
  double most = 0.0;
  double error = 0.0;  // largest of adaptive [m]
  bool holds = false;
  Json chart;
};

Figure2 figure_2(const std::string& title, const std::shared_ptr<const Scene>& scene,
                 Settings settings, std::vector<double> RunTrace::*error,
                 const Reproduction& options) {
  constexpr int kMost = 40;
  const double seconds = scene->criteria.duration;
  std::vector<Run> runs{{scene, settings, seconds}};
  settings.mode = Mode::kConst;
  for (settings.n = 1; settings.n <= kMost; ++settings.n)
    runs.push_back({scene, settings, seconds});
  const std::vector<RunTrace> traces = trace_all(runs, options);
  const RunTrace& adaptive = traces.front();
  Figure2 figure;
  figure.error = peak(adaptive.*error);
  figure.holds = adaptive.holds;
  figure.least = quantile(by_frame(adaptive), 0.0);
  figure.median = quantile(by_frame(adaptive), 0.5);
  figure.most = peak(by_frame(adaptive));
  for (int n = kMost; n >= 1; --n) {  // from above: an error may dip under the limit by chance
    const RunTrace& constant = traces[static_cast<std::size_t>(n)];
    if (!constant.holds || peak(constant.*error) > figure.error) break;
    figure.n = n;
  }
  std::vector<Curve> curves{substeps_curve("adaptive, alpha 0.1", adaptive)};
  if (figure.n > 0) {
    const RunTrace& constant = traces[static_cast<std::size_t>(figure.n)];
    figure.fewer = 1.0 - adaptive.total_substeps() / constant.total_substeps();
    curves.push_back(substeps_curve(text("constant %d", figure.n), constant));
    curves.back().dashed = true;
  }
  figure.chart = chart_json(title, "", "time [s]", "sub-steps of a frame", false, curves);
  return figure;
}

std::string told(const Figure2& f) {
  std::string words =
      text("%g / %g / %g sub-steps a frame (least, median, most)", f.least, f.median, f.most);
  if (f.n == 0) return words + ", with an error that no constant number up to 40 undercuts";
  words += text(", %.0f %% %s than the constant %d that keeps as small an error",
                100.0 * std::abs(f.fewer), f.fewer >= 0.0 ? "fewer" : "more", f.n);
  return words;
}

Card sub_steps_over_time(const Reproduction& options) {
  Card card;
  card.title = "Fig. 2: sub-steps over time";
  card.paper =
      "The number of sub-steps follows the stiffness: most at the bottom of the swing, and while "
      "the "
      "ball is on the bridge. A constant number has to serve the worst frame.";
  const auto box = shared(scenes::swinging_box());
  Scene short_bridge = scenes::bridge();
  short_bridge.criteria.duration = 6.0;
  const auto bridge = shared(short_bridge);
  const Figure2 swing = figure_2("Swinging box, direct solver", box, direct(Mode::kAdaptive),
                                 &RunTrace::constraint_error, options);
  const Figure2 gauss = figure_2("Swinging box, Gauss-Seidel with 25 iterations", box,
                                 pgs(Mode::kAdaptive), &RunTrace::constraint_error, options);
  const Figure2 crossing = figure_2("Bridge, direct solver", bridge, direct(Mode::kAdaptive),
                                    &RunTrace::joint_gap, options);
  card.here = "Swinging box: " + told(swing) + ". With Gauss-Seidel: " + told(gauss) +
              ". Bridge: " + told(crossing) + ".";
  card.why =
      "How much is saved depends on what the constant number is tuned to. Against the one that "
      "keeps "
      "as small an error as adaptive does at its worst, as here, it saves; against the smallest "
      "that "
      "merely holds (7 on the swinging box) it does not, but only trial tells that number.";
  card.command = "substep run swinging_box --csv -";
  const bool follows = swing.holds && gauss.holds && crossing.holds &&
                       swing.most > 1.5 * swing.least && crossing.most > 3.0 * crossing.least;
  card.outcome = follows ? Outcome::kAgrees : Outcome::kFails;
  card.charts = {swing.chart, gauss.chart, crossing.chart};
  return card;
}

Card energy_over_time(const Reproduction& options) {
  constexpr double kSeconds = 200.0;
  Card card;
  card.title = "Fig. 3: kinetic energy over 200 s";
  card.paper = "Adaptive damping slows the swing down; adaptive sub-steps keep its energy.";
  const auto scene = shared(scenes::swinging_box());
  Settings leapfrog = direct(Mode::kAdaptive);
  leapfrog.integrator = Integrator::kLeapfrog;
  const std::vector<RunTrace> traces = trace_all({{scene, direct(Mode::kAdaptive), kSeconds},
                                                  {scene, leapfrog, kSeconds},
                                                  {scene, direct(Mode::kDamping), kSeconds},
                                                  {scene, direct(Mode::kNone), kSeconds}},
                                                 options);
  const auto drift = [&](const RunTrace& trace) {
    return 100.0 * (trace.energy.back() - trace.energy.front()) / *scene->criteria.energy_scale;
  };
  if (*options.cancelled) return card;
  card.here = text(
      "After 200 s damping has lost %.1f %% of the energy that goes back and forth, adaptive "
      "sub-steps %.1f %%; with leapfrog, at the same cost, the energy has changed by %.1g %%. "
      "Without either the chain %s.",
      -drift(traces[2]), -drift(traces[0]), drift(traces[1]), life(traces[3]).c_str());
  card.why =
      "The small loss of adaptive sub-steps comes from changing the step under the semi-implicit "
      "Euler rule, whose velocities lag half a step behind. Leapfrog has no such lag.";
  card.command = "substep run swinging_box --seconds 200 --mode damping";
  const bool as_before =
      traces[0].holds && traces[2].holds && std::abs(drift(traces[2]) + 97.8) < 4.9 &&
      std::abs(drift(traces[0]) + 2.8) < 0.14 && std::abs(drift(traces[1])) < 1e-3;
  card.outcome = as_before ? Outcome::kAgrees : Outcome::kFails;
  const char* names[] = {"adaptive, alpha 0.1", "adaptive with leapfrog", "damping", "none"};
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    // Of every swing its largest energy: the swings themselves would be a solid band.
    Curve curve{names[i], {}, {}, traces[i].holds ? "" : traces[i].verdict, !traces[i].holds};
    const auto& kinetic = traces[i].kinetic;
    for (std::size_t k = 1; k + 1 < kinetic.size(); ++k) {
      if (kinetic[k] < kinetic[k - 1] || kinetic[k] < kinetic[k + 1] || kinetic[k] < 500.0)
        continue;
      curve.x.push_back(traces[i].time[k]);
      curve.y.push_back(kinetic[k]);
    }
    if (!traces[i].holds) {
      curve.x.push_back(traces[i].time.back());
      curve.y.push_back(kinetic.back());
    }
    curves.push_back(std::move(curve));
  }
  card.charts = {chart_json("Largest kinetic energy of every swing", "", "time [s]",
                            "kinetic energy [J]", false, curves)};
  return card;
}

Card heavy_stack(const Reproduction& options) {
  constexpr double kSeconds = 10.0;
  Card card;
  card.title = "Fig. 4: heavy stack by solver and mode";
  card.paper = "Only adaptive sub-steps with the direct solver keep the stack standing.";
  const auto plain = shared(scenes::heavy_stack());
  const auto stress = shared(scenes::heavy_stack_stress());
  struct Case {
    const char* name;
    Settings settings;
  };
  const std::vector<Case> cases{
      {"none", direct(Mode::kNone)},
      {"damping", direct(Mode::kDamping)},
      {"const 4", direct(Mode::kConst, 4)},
      {"const 8", direct(Mode::kConst, 8)},
      {"adaptive", direct(Mode::kAdaptive)},
      {"adaptive, Gauss-Seidel 25", pgs(Mode::kAdaptive)},
      {"adaptive, Gauss-Seidel 200", pgs(Mode::kAdaptive, Drift::kAuto, 200)}};
  std::vector<Run> runs;
  for (const auto& scene : {stress, plain}) {
    for (const Case& one : cases) runs.push_back({scene, one.settings, kSeconds});
  }
  const std::vector<RunTrace> traces = trace_all(runs, options);
  std::string in_stress;
  std::string in_plain;
  std::vector<Curve> curves;
  bool direct_stands = true;
  bool gauss_falls = true;
  bool pattern = true;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const RunTrace& stressed = traces[i];
    const RunTrace& exact = traces[cases.size() + i];
    const char* comma = i == 0 ? "" : ", ";
    in_stress += comma + std::string(cases[i].name) + " " + life(stressed);
    in_plain += comma + std::string(cases[i].name) + " " + life(exact);
    const bool is_pgs = cases[i].settings.solver == SolverKind::kPgs;
    (is_pgs ? gauss_falls : direct_stands) &= is_pgs ? !exact.holds : exact.holds;
    pattern &= stressed.holds == (cases[i].settings.mode == Mode::kAdaptive && !is_pgs);
    Curve curve{
        cases[i].name, stressed.time, {}, stressed.holds ? "" : life(stressed), !stressed.holds};
    for (const Vec3& x : stressed.track) curve.y.push_back(x.y());
    curves.push_back(std::move(curve));
  }
  card.here =
      "With a start jitter and a regularisation that stands for finite precision "
      "(heavy_stack_stress): " +
      in_stress + ". In plain double precision: " + in_plain + ".";
  card.why =
      "In exact arithmetic the constrained stiffness of the symmetric stack is zero: nothing to "
      "fall. "
      "What makes it fall is finite precision or softness, which no step shrinks. In double "
      "precision "
      "every direct mode stands, even a single step; with a stated imprecision the paper's pattern "
      "appears.";
  card.command = "substep run heavy_stack_stress --mode const --n 8";
  card.outcome = !(pattern && gauss_falls) ? Outcome::kFails
                 : direct_stands           ? Outcome::kDiffers
                                           : Outcome::kAgrees;
  card.charts = {chart_json("Height of the heavy box, heavy_stack_stress", "", "time [s]",
                            "height of its centre [m]", false, curves)};
  return card;
}

Card explodes(const Reproduction& options) {
  Card card;
  card.title = "The swinging box explodes without sub-steps or damping";
  card.paper = "It does, and with the direct solver too: an exact solve does not help.";
  const auto scene = shared(scenes::swinging_box());
  std::vector<Run> runs;
  for (int n = 1; n <= 8; ++n) runs.push_back({scene, direct(Mode::kConst, n), 10.0});
  Settings threshold = direct(Mode::kAdaptive, 16, 1.0);
  threshold.integrator = Integrator::kLeapfrog;
  runs.push_back({scene, threshold, 10.0});
  const std::vector<RunTrace> traces = trace_all(runs, options);
  int least = 9;
  for (int n = 8; n >= 1 && traces[static_cast<std::size_t>(n - 1)].holds; --n) least = n;
  const int predicted = static_cast<int>(peak(by_frame(traces.back())));
  std::vector<Curve> curves;
  card.here = "";
  for (int n = 1; n <= 8; ++n) {
    const RunTrace& trace = traces[static_cast<std::size_t>(n - 1)];
    if (n > 1) card.here += ", ";
    card.here += text("%d sub-step%s a frame: ", n, n == 1 ? "" : "s") + life(trace);
    if (n == 3 || n == 5) continue;  // enough curves tell it
    curves.push_back(
        {text("%d", n), trace.time, trace.joint_gap, trace.holds ? "" : life(trace), !trace.holds});
  }
  card.here += text(
      ". The smallest that holds is %d, and alpha = 1, the stability limit itself, "
      "predicts %d.",
      least, predicted);
  card.command = "substep run swinging_box --mode none";
  card.outcome = !traces.front().holds && least == predicted ? Outcome::kAgrees : Outcome::kFails;
  card.charts = {chart_json("Largest joint gap by constant sub-steps", "", "time [s]",
                            "joint gap [m]", true, curves)};
  return card;
}

Card alpha_law(const Reproduction& options) {
  Card card;
  card.title = "What alpha does";
  card.paper =
      "Its text: halving alpha doubles the number of sub-steps. Its Eq. 10: dt goes with the "
      "root of alpha.";
  const auto scene = shared(scenes::swinging_box());
  std::vector<Run> runs;
  Curve measured;
  measured.name = "mean sub-steps";
  for (const double alpha : {0.2, 0.1, 0.05, 0.025, 0.0125}) {
    Settings settings = direct(Mode::kAdaptive, 16, alpha);
    settings.n_max = 1000;
    runs.push_back({scene, settings, 10.0});
    measured.x.push_back(alpha);
  }
  const std::vector<RunTrace> traces = trace_all(runs, options);
  for (const RunTrace& trace : traces) {
    measured.y.push_back(trace.total_substeps() / static_cast<double>(trace.time.size() - 1));
  }
  // Rounding up adds half a sub-step on average.
  const auto steps = static_cast<double>(measured.y.size() - 1);
  const double factor =
      std::pow((measured.y.back() - 0.5) / (measured.y.front() - 0.5), 1.0 / steps);
  card.here = text("Each halving multiplies the sub-steps by %.3f; sqrt 2 is 1.414.", factor);
  card.why = "Eq. 10 is right and the sentence is a slip: N goes with alpha to the power -1/2.";
  card.command = "substep run swinging_box --alpha 0.05";
  card.outcome = std::abs(factor - std::sqrt(2.0)) < 0.015 ? Outcome::kDiffers : Outcome::kFails;
  card.charts = {chart_json("Sub-steps by alpha", "", "alpha", "mean sub-steps of a frame", false,
                            {measured})};
  return card;
}

Card gauss_seidel(const Reproduction& options) {
  Card card;
  card.title = "Swinging box with Gauss-Seidel, 25 iterations";
  card.paper = "It runs with adaptive sub-steps.";
  const auto scene = shared(scenes::swinging_box());
  const std::vector<RunTrace> traces =
      trace_all({{scene, pgs(Mode::kAdaptive, Drift::kFull), 10.0},
                 {scene, pgs(Mode::kAdaptive, Drift::kFull, 400), 10.0},
                 {scene, pgs(Mode::kAdaptive, Drift::kSoft), 10.0}},
                options);
  card.here = "With the paper's drift law phi/h: " + life(traces[0]) + "; with 400 iterations " +
              life(traces[1]) + ". With errors taken back slowly (drift soft): " + life(traces[2]) +
              ".";
  card.why =
      "An error that a long sub-step leaves is paid back in a short one at full rate: changing "
      "steps "
      "feed energy in. phi dt/tau^2 does not; a constant step does not either.";
  card.command = "substep run swinging_box --solver pgs --drift full";
  card.outcome =
      traces[2].holds ? (traces[0].holds ? Outcome::kAgrees : Outcome::kDiffers) : Outcome::kFails;
  const char* names[] = {"drift full, 25 iterations", "drift full, 400", "drift soft, 25"};
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    curves.push_back({names[i], traces[i].time, traces[i].constraint_error,
                      traces[i].holds ? "" : life(traces[i]), !traces[i].holds});
  }
  card.charts = {chart_json("Constraint error, 1-norm over all joints", "", "time [s]",
                            "error [m, rad]", true, curves)};
  return card;
}

Card bridge(const Reproduction& options) {
  Card card;
  card.title = "Bridge";
  card.paper = "It tears without stabilisation; damping and adaptive sub-steps hold.";
  const std::vector<std::pair<const char*, Settings>> modes{
      {"none", direct(Mode::kNone)},         {"damping", direct(Mode::kDamping)},
      {"const 8", direct(Mode::kConst, 8)},  {"const 16", direct(Mode::kConst, 16)},
      {"adaptive", direct(Mode::kAdaptive)}, {"capped at 4", direct(Mode::kCapped)}};
  const auto starts = scenes::bridge_starts();
  std::vector<Run> runs;
  for (const auto& [name, settings] : modes) {
    for (const auto& start : starts) runs.push_back({shared(scenes::bridge(start)), settings, 6.0});
  }
  const std::vector<RunTrace> traces = trace_all(runs, options);
  std::vector<int> survivors(modes.size(), 0);
  std::vector<double> substeps(modes.size(), 0.0);
  for (std::size_t i = 0; i < traces.size(); ++i) {
    survivors[i / starts.size()] += traces[i].holds ? 1 : 0;
    substeps[i / starts.size()] += traces[i].total_substeps();
  }
  std::vector<Curve> curves;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    if (m > 0) card.here += ", ";
    card.here += text("%s %d of %zu", modes[m].first, survivors[m], starts.size());
    const RunTrace& trace = traces[m * starts.size()];
    curves.push_back({modes[m].first, trace.time, trace.joint_gap, trace.holds ? "" : life(trace),
                      !trace.holds});
  }
  card.here = "Starts that survive 6 s: " + card.here +
              text(". Adaptive takes %.0f %% fewer sub-steps than const 16.",
                   100.0 * (1.0 - substeps[4] / substeps[3]));
  card.command = "substep run bridge --mode none";
  const int all = static_cast<int>(starts.size());
  card.outcome = survivors[0] == 0 && survivors[1] >= all - 1 && survivors[4] >= all - 1
                     ? Outcome::kAgrees
                     : Outcome::kFails;
  card.charts = {
      chart_json("Largest joint gap, first start", "", "time [s]", "joint gap [m]", true, curves)};
  return card;
}

Card taller_stack(const Reproduction& options) {
  Card card;
  card.title = "The taller stack needs a smaller alpha";
  card.paper = "With 10 layers under 20 t alpha has to be 0.05.";
  const auto scene = shared(scenes::heavy_stack_stress_tall());
  const std::vector<RunTrace> traces = trace_all({{scene, direct(Mode::kAdaptive, 16, 0.1), 10.0},
                                                  {scene, direct(Mode::kAdaptive, 16, 0.05), 10.0}},
                                                 options);
  card.here = "heavy_stack_stress_tall: alpha 0.1 " + life(traces[0]) + ", alpha 0.05 " +
              life(traces[1]) + ".";
  card.command = "substep run heavy_stack_stress_tall --alpha 0.1";
  card.outcome = !traces[0].holds && traces[1].holds ? Outcome::kAgrees : Outcome::kFails;
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    Curve curve{i == 0 ? "alpha 0.1" : "alpha 0.05",
                traces[i].time,
                {},
                traces[i].holds ? "" : life(traces[i]),
                !traces[i].holds};
    for (const Vec3& x : traces[i].track) curve.y.push_back(x.y());
    curves.push_back(std::move(curve));
  }
  card.charts = {chart_json("Height of the heavy box", "", "time [s]", "height of its centre [m]",
                            false, curves)};
  return card;
}

Card capped(const Reproduction& options) {
  Card card;
  card.title = "Future work: a cap on the sub-steps, and damping beyond it";
  card.paper = "Proposed, not shown: at most so many sub-steps as there is time for, then damping.";
  const auto scene = shared(scenes::swinging_box());
  std::vector<Run> runs;
  const std::vector<int> caps{1, 2, 4, 8, 16};
  for (const int cap : caps) {
    Settings settings = direct(Mode::kCapped);
    settings.n_cap = cap;
    runs.push_back({scene, settings, 10.0});
  }
  const std::vector<RunTrace> traces = trace_all(runs, options);
  std::vector<Curve> curves;
  bool all_hold = true;
  double before = -101.0;
  bool less_and_less = true;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const double lost = 100.0 * (traces[i].energy.back() - traces[i].energy.front()) /
                        *scene->criteria.energy_scale;
    if (i > 0) card.here += ", ";
    card.here += text("%d: %.2g %%", caps[i], lost);
    all_hold &= traces[i].holds;
    less_and_less &= lost > before;
    before = lost;
    curves.push_back({text("at most %d", caps[i]), traces[i].time, traces[i].kinetic,
                      traces[i].holds ? "" : life(traces[i]), !traces[i].holds});
  }
  card.here =
      std::string(all_hold ? "The swinging box holds at every cap" : "Not every cap holds") +
      "; its energy after 10 s, by cap: " + card.here + ".";
  card.command = "substep run swinging_box --mode capped --n-cap 4";
  card.outcome = all_hold && less_and_less ? Outcome::kAgrees : Outcome::kFails;
  card.charts = {
      chart_json("Kinetic energy by cap", "", "time [s]", "kinetic energy [J]", false, curves)};
  return card;
}

}  // namespace

std::vector<Card> reproduce(const Reproduction& options) {
  struct Part {
    const char* name;
    Card (*run)(const Reproduction&);
  };
  const std::vector<Part> parts{{"Fig. 2", sub_steps_over_time},
                                {"Fig. 3", energy_over_time},
                                {"Fig. 4", heavy_stack},
                                {"explosion", explodes},
                                {"alpha", alpha_law},
                                {"Gauss-Seidel", gauss_seidel},
                                {"bridge", bridge},
                                {"taller stack", taller_stack},
                                {"cap", capped}};
  std::vector<Card> cards;
  for (const Part& part : parts) {
    if (*options.cancelled) break;
    options.on_card(cards.size(), parts.size(), part.name);
    cards.push_back(part.run(options));
  }
  return cards;
}

}  // namespace substep::cli
