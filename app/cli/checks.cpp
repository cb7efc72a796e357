#include "app/cli/checks.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <thread>

#include "app/cli/in_parallel.hpp"
#include "core/io/experiment.hpp"

namespace substep::cli {
namespace {

/// @return false if cancelled
bool run(Check& check, const std::atomic<bool>& cancelled) {
  const auto start = std::chrono::steady_clock::now();
  const Scene& scene = *check.scene;
  ExperimentRun run(scene, experiment_of(scene, check.cell.settings, check.seed), no_reference());
  while (!cancelled && run.advance()) {
  }
  if (cancelled) return false;
  check.judgement = judge(scene, check.cell.expected, run);
  check.metrics = run.result().metrics;
  check.time = run.simulator().state().time;
  check.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  check.done = true;
  return true;
}

}  // namespace

bool run_checks(std::vector<Check>& checks, int jobs,
                const std::function<void(const Check&)>& on_done,
                const std::atomic<bool>& cancelled) {
  std::size_t reported = 0;
  std::mutex mutex;
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  if (jobs == 0) jobs = std::max(1, processors);
  in_parallel(checks.size(), jobs, [&](std::size_t i) {
    Check check = checks[i];
    if (cancelled || !run(check, cancelled)) return false;
    const std::lock_guard lock(mutex);
    checks[i] = std::move(check);
    while (reported < checks.size() && checks[reported].done) on_done(checks[reported++]);
    return std::ferror(stdout) == 0;  // else the output is closed: stop
  });
  for (; reported < checks.size(); ++reported) {  // finished after a cancelled one
    if (checks[reported].done) on_done(checks[reported]);
  }
  return !cancelled;
}

}  // namespace substep::cli
