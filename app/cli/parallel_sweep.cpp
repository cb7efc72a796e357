#include "app/cli/parallel_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>

#include "app/cli/cancel.hpp"
#include "app/cli/in_parallel.hpp"

namespace substep::cli {
namespace {

/// The experiments by estimated cost, the most expensive first, so that the threads end at about
/// the same time.
std::vector<std::size_t> dearest_first(const std::vector<double>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  return order;
}

}  // namespace

bool run_sweep(const ParallelSweep& sweep) {
  if (sweep.experiments.empty()) return true;
  double longest = 0.0;       // [s]
  std::vector<double> costs;  // estimates
  for (const Experiment& experiment : sweep.experiments) {
    longest = std::max(longest, experiment.duration);
    costs.push_back(expected_work(*sweep.scene, experiment));
  }
  const double all = std::accumulate(costs.begin(), costs.end(), 0.0);
  const std::vector<std::size_t> order = dearest_first(costs);

  std::atomic<bool> failed{false};
  const auto stopping = [&] { return failed || cancel_on_signal(); };
  std::optional<Reference> found;
  if (sweep.reference == nullptr) {
    ReferenceRun run(sweep.scene, longest);
    while (!stopping() && run.advance()) sweep.on_progress(0.0);
    if (stopping()) return false;
    found = run.reference();
  }
  const Reference& reference = found ? *found : *sweep.reference;

  std::vector<std::atomic<double>> done(costs.size());  // share of each run
  const auto run_one = [&](std::size_t i) {
    const std::size_t at = order[i];
    ExperimentRun run(*sweep.scene, sweep.experiments[at], reference);
    while (!stopping() && run.advance()) done[at] = run.progress();
    if (stopping()) return false;
    done[at] = 1.0;
    if (!sweep.on_result(at, run.result())) failed = true;
    return !failed;
  };
  const auto run_or_fail = [&](std::size_t i) {
    try {
      return run_one(i);
    } catch (...) {
      failed = true;  // ends the other runs within a frame
      throw;
    }
  };
  in_parallel(costs.size(), sweep.jobs, run_or_fail, [&] {
    const double work = std::inner_product(done.begin(), done.end(), costs.begin(), 0.0);
    sweep.on_progress(all > 0.0 ? work / all : 1.0);
  });
  return !stopping();
}

}  // namespace substep::cli
