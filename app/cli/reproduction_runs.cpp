#include "app/cli/reproduction_runs.hpp"

#include <algorithm>

#include "app/cli/cancel.hpp"
#include "app/cli/in_parallel.hpp"
#include "core/model/format_text.hpp"

namespace substep::cli {

Settings direct(Mode mode, int n, double alpha) {
  PaperSettings settings;
  settings.mode = n == 1 && mode == Mode::kConst ? Mode::kNone : mode;
  settings.n = n;
  settings.alpha = alpha;
  return settings;
}

Settings pgs(Mode mode, Drift drift, int iterations) {
  Settings settings = direct(mode);
  settings.solver = SolverKind::kPgs;
  settings.iterations = iterations;
  settings.drift = drift;
  return settings;
}

std::shared_ptr<const Scene> shared(Scene scene) {
  return std::make_shared<const Scene>(std::move(scene));
}

std::vector<RunTrace> trace_all(const std::vector<Run>& runs, int jobs) {
  std::vector<RunTrace> traces(runs.size());
  in_parallel(runs.size(), jobs, [&](std::size_t i) {
    if (cancel_on_signal()) return false;
    traces[i] = trace_run(runs[i].scene, runs[i].settings, runs[i].seconds);
    return true;
  });
  return traces;
}

std::vector<Curve> curves_of(const std::vector<Run>& runs, const std::vector<RunTrace>& traces,
                             std::vector<double> RunTrace::*value) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunTrace& trace = traces[i];
    curves.push_back(
        {runs[i].name, trace.time, trace.*value, trace.holds ? "" : life(trace), !trace.holds});
  }
  return curves;
}

std::string life(const RunTrace& trace) {
  return trace.holds ? "holds" : format_text("fails at %.2f s", trace.failed_at);
}

std::string lives(const std::vector<Run>& runs, const std::vector<RunTrace>& traces,
                  std::size_t first, std::size_t count) {
  std::string words;
  for (std::size_t i = first; i < first + count; ++i) {
    if (i > first) words += ", ";
    words += runs[i].name + " " + life(traces[i]);
  }
  return words;
}

double peak(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

std::vector<double> by_frame(const RunTrace& trace) {
  if (trace.substeps.empty()) return {};
  return {trace.substeps.begin() + 1, trace.substeps.end()};
}

double energy_change(const Scene& scene, const RunTrace& trace) {
  if (trace.energy.empty()) return 0.0;
  return 100.0 * (trace.energy.back() - trace.energy.front()) / *scene.criteria.energy_scale;
}

}  // namespace substep::cli
