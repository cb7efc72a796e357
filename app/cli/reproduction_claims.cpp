// The paper's claims in words.

#include <cmath>

#include "app/cli/reproduction.hpp"
#include "app/cli/reproduction_runs.hpp"
#include "core/model/format_text.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {

using Outcome = Card::Outcome;

Card explosion(int jobs) {
  constexpr int kMost = 8;
  Card card;
  card.title = "The swinging box explodes without sub-steps or damping";
  card.paper = "It does, even with the direct solver: an exact solve does not help.";
  const auto scene = shared(scenes::swinging_box());
  std::vector<Run> runs;
  for (int n = 1; n <= kMost; ++n) {
    runs.push_back({format_text("%d", n), scene, direct(Mode::kConst, n), 10.0});
  }
  Settings threshold = direct(Mode::kAdaptive, 16, 1.0);
  threshold.integrator = Integrator::kLeapfrog;
  runs.push_back({"alpha 1", scene, threshold, 10.0});
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  int least = kMost + 1;
  while (least > 1 && traces[static_cast<std::size_t>(least - 2)].holds) --least;
  const int predicted = static_cast<int>(peak(by_frame(traces.back())));
  card.here = "By sub-steps per frame: " + lives(runs, traces, 0, kMost) +
              format_text(
                  ". The smallest that holds is %d, and alpha = 1, the stability limit itself, "
                  "predicts %d.",
                  least, predicted);
  card.command = "substep run swinging_box --mode none";
  card.outcome = !traces.front().holds && least == predicted ? Outcome::kAgrees : Outcome::kFails;
  runs.pop_back();
  card.charts = {chart_json("Largest joint gap by constant sub-steps", "", "time [s]",
                            "joint gap [m]", true, curves_of(runs, traces, &RunTrace::joint_gap))};
  return card;
}

Card alpha_law(int jobs) {
  Card card;
  card.title = "What alpha does";
  card.paper =
      "The text: halving alpha doubles the number of sub-steps. Eq. 10: dt is proportional to the "
      "square root of alpha.";
  const auto scene = shared(scenes::swinging_box());
  std::vector<Run> runs;
  Curve measured;
  measured.name = "mean sub-steps";
  for (const double alpha : {0.2, 0.1, 0.05, 0.025, 0.0125}) {
    Settings settings = direct(Mode::kAdaptive, 16, alpha);
    settings.n_max = 1000;
    runs.push_back({format_text("alpha %g", alpha), scene, settings, 10.0});
    measured.x.push_back(alpha);
  }
  for (const RunTrace& trace : trace_all(runs, jobs)) {
    measured.y.push_back(trace.total_substeps() / static_cast<double>(trace.time.size() - 1));
  }
  // Rounding up adds half a sub-step on average.
  const auto halvings = static_cast<double>(measured.y.size() - 1);
  const double factor =
      std::pow((measured.y.back() - 0.5) / (measured.y.front() - 0.5), 1.0 / halvings);
  card.here =
      format_text("Each halving multiplies the sub-steps by %.3f; sqrt 2 is 1.414.", factor);
  card.why =
      "Eq. 10 is correct and the sentence is an error: N is proportional to alpha to the power "
      "-1/2.";
  card.command = "substep run swinging_box --alpha 0.05";
  card.outcome = std::abs(factor - std::sqrt(2.0)) < 0.015 ? Outcome::kDiffers : Outcome::kFails;
  card.charts = {
      chart_json("Sub-steps by alpha", "", "alpha", "mean sub-steps per frame", false, {measured})};
  return card;
}

Card gauss_seidel(int jobs) {
  Card card;
  card.title = "Swinging box with Gauss-Seidel, 25 iterations";
  card.paper = "It runs with adaptive sub-steps.";
  const auto scene = shared(scenes::swinging_box());
  const std::vector<Run> runs{
      {"drift full, 25 iterations", scene, pgs(Mode::kAdaptive, Drift::kFull), 10.0},
      {"drift full, 400 iterations", scene, pgs(Mode::kAdaptive, Drift::kFull, 400), 10.0},
      {"drift soft, 25 iterations", scene, pgs(Mode::kAdaptive, Drift::kSoft), 10.0}};
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  card.here = "With the paper's drift law phi/h: " + life(traces[0]) + "; with 400 iterations " +
              life(traces[1]) + ". With a slow drift correction (drift soft): " + life(traces[2]) +
              ".";
  card.why =
      "A short sub-step corrects the error of a long one at full rate: variable steps add energy. "
      "phi dt/tau^2 does not, nor does a constant step.";
  card.command = "substep run swinging_box --solver pgs --drift full";
  card.outcome =
      traces[2].holds ? (traces[0].holds ? Outcome::kAgrees : Outcome::kDiffers) : Outcome::kFails;
  card.charts = {chart_json("Constraint error, 1-norm over all joints", "", "time [s]",
                            "error [m, rad]", true,
                            curves_of(runs, traces, &RunTrace::constraint_error))};
  return card;
}

Card bridge(int jobs) {
  struct Method {
    const char* name;
    Settings settings;
    int survivors = 0;
    double substeps = 0.0;
  };
  Card card;
  card.title = "Bridge";
  card.paper = "It tears without stabilisation; damping and adaptive sub-steps hold.";
  std::vector<Method> methods{
      {"none", direct(Mode::kNone)},         {"damping", direct(Mode::kDamping)},
      {"const 8", direct(Mode::kConst, 8)},  {"const 16", direct(Mode::kConst, 16)},
      {"adaptive", direct(Mode::kAdaptive)}, {"capped at 4", direct(Mode::kCapped)}};
  const auto starts = scenes::bridge_starts();
  std::vector<Run> runs;  // the first seed of every method, then the second, ...
  for (const auto& start : starts) {
    const auto scene = shared(scenes::bridge(start));
    for (const Method& method : methods) runs.push_back({method.name, scene, method.settings, 6.0});
  }
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  for (std::size_t i = 0; i < traces.size(); ++i) {
    Method& method = methods[i % methods.size()];
    method.survivors += traces[i].holds ? 1 : 0;
    method.substeps += traces[i].total_substeps();
  }
  for (const Method& method : methods) {
    card.here += card.here.empty() ? "Starts that survive 6 s: " : ", ";
    card.here += format_text("%s %d of %zu", method.name, method.survivors, starts.size());
  }
  card.here += format_text(". Adaptive takes %.0f %% fewer sub-steps than const 16.",
                           100.0 * (1.0 - methods[4].substeps / methods[3].substeps));
  card.command = "substep run bridge --mode none";
  const int most = static_cast<int>(starts.size()) - 1;
  const bool as_claimed =
      methods[0].survivors == 0 && methods[1].survivors >= most && methods[4].survivors >= most;
  card.outcome = as_claimed ? Outcome::kAgrees : Outcome::kFails;
  runs.resize(methods.size());
  card.charts = {chart_json("Largest joint gap, first start", "", "time [s]", "joint gap [m]", true,
                            curves_of(runs, traces, &RunTrace::joint_gap))};
  return card;
}

Card taller_stack(int jobs) {
  Card card;
  card.title = "The taller stack needs a smaller alpha";
  card.paper = "With 10 layers under 20 t alpha has to be 0.05.";
  const auto scene = shared(scenes::heavy_stack_stress_tall());
  const std::vector<Run> runs{{"alpha 0.1", scene, direct(Mode::kAdaptive, 16, 0.1), 10.0},
                              {"alpha 0.05", scene, direct(Mode::kAdaptive, 16, 0.05), 10.0}};
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  card.here = "heavy_stack_stress_tall: " + lives(runs, traces, 0, runs.size()) + ".";
  card.command = "substep run heavy_stack_stress_tall --alpha 0.1";
  card.outcome = !traces[0].holds && traces[1].holds ? Outcome::kAgrees : Outcome::kFails;
  card.charts = {chart_json("Height of the heavy box", "", "time [s]", "height of its centre [m]",
                            false, curves_of(runs, traces, &RunTrace::height))};
  return card;
}

Card capped(int jobs) {
  Card card;
  card.title = "Future work: a cap on the sub-steps, and damping beyond it";
  card.paper = "Proposed, not shown: as many sub-steps as the time permits, then damping.";
  const auto scene = shared(scenes::swinging_box());
  std::vector<Run> runs;
  for (const int cap : {1, 2, 4, 8, 16}) {
    Settings settings = direct(Mode::kCapped);
    settings.n_cap = cap;
    runs.push_back({format_text("at most %d", cap), scene, settings, 10.0});
  }
  const std::vector<RunTrace> traces = trace_all(runs, jobs);
  bool all_hold = true;
  bool less_and_less = true;
  double before = -101.0;
  std::string losses;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const double change = energy_change(*scene, traces[i]);
    losses += format_text("%s%s %.2g %%", i > 0 ? ", " : "", runs[i].name.c_str(), change);
    all_hold &= traces[i].holds;
    less_and_less &= change > before;
    before = change;
  }
  card.here = (all_hold ? "The swinging box holds at every cap" : "Not every cap holds") +
              std::string("; its energy after 10 s has changed by: ") + losses + ".";
  card.command = "substep run swinging_box --mode capped --n-cap 4";
  card.outcome = all_hold && less_and_less ? Outcome::kAgrees : Outcome::kFails;
  card.charts = {chart_json("Kinetic energy by cap", "", "time [s]", "kinetic energy [J]", false,
                            curves_of(runs, traces, &RunTrace::kinetic))};
  return card;
}

}  // namespace substep::cli
