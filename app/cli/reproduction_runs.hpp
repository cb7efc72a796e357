#pragma once
// Helpers for the cards of the reproduction: parallel runs, and texts and curves from them.

#include <memory>
#include <string>
#include <vector>

#include "app/cli/report.hpp"
#include "app/cli/run_trace.hpp"

namespace substep::cli {

struct Run {
  std::string name;
  std::shared_ptr<const Scene> scene;
  Settings settings;
  double seconds;  // [s]
};

/// The paper's settings with the direct solver. Constant 1 is mode none.
Settings direct(Mode mode, int n = 16, double alpha = 0.1);
/// The same with Gauss-Seidel.
Settings pgs(Mode mode, Drift drift = Drift::kAuto, int iterations = 25);

std::shared_ptr<const Scene> shared(Scene scene);

/// Traces all runs on `jobs` threads. @return in the order of `runs`
std::vector<RunTrace> trace_all(const std::vector<Run>& runs, int jobs);

/// One quantity of each run over time.
std::vector<Curve> curves_of(const std::vector<Run>& runs, const std::vector<RunTrace>& traces,
                             std::vector<double> RunTrace::*value);

/// "holds", "fails at 0.35 s"
std::string life(const RunTrace& trace);
/// "none fails at 0.90 s, adaptive holds": for `count` runs from `first`.
std::string lives(const std::vector<Run>& runs, const std::vector<RunTrace>& traces,
                  std::size_t first, std::size_t count);

double peak(const std::vector<double>& values);
/// The quantile of the values at `share`, 0 to 1.
double quantile(std::vector<double> values, double share);
/// Sub-steps of the frames, without the start.
std::vector<double> by_frame(const RunTrace& trace);
/// Change of energy over the run, as a percentage of the scene's scale [%].
double energy_change(const Scene& scene, const RunTrace& trace);

}  // namespace substep::cli
