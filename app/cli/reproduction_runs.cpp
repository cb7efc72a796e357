#include "app/cli/reproduction_runs.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "core/model/format_text.hpp"

namespace substep::cli {

Settings direct(Mode mode, int n, double alpha) {
  Settings settings;
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

std::vector<RunTrace> trace_all(const std::vector<Run>& runs, const Reproduction& options) {
  std::vector<RunTrace> traces(runs.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < runs.size() && !*options.cancelled; i = next++) {
        traces[i] = trace_run(runs[i].scene, runs[i].settings, runs[i].seconds);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      error = std::current_exception();
      next = runs.size();
    }
  };
  std::vector<std::thread> threads;
  try {
    for (int i = 1; i < options.jobs; ++i) threads.emplace_back(work);
  } catch (const std::system_error&) {
    // No more threads available: continue with fewer.
  }
  work();
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
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
