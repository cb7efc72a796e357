#include "app/cli/checks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "core/io/experiment.hpp"

namespace substep::cli {
namespace {

void run(Check& check) {
  const auto start = std::chrono::steady_clock::now();
  const Scene& scene = *check.scene;
  ExperimentRun run(scene, experiment_of(scene, check.cell.settings, check.seed), no_reference());
  while (run.advance()) {
  }
  check.judgement = judge(scene, check.cell.expected, run);
  check.metrics = run.result().metrics;
  check.time = run.simulator().state().time;
  check.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  check.done = true;
}

}  // namespace

void run_checks(std::vector<Check>& checks, int jobs,
                const std::function<void(const Check&)>& on_done) {
  std::atomic<std::size_t> next{0};
  std::size_t told = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < checks.size(); i = next++) {
      Check check = checks[i];
      run(check);
      const std::lock_guard lock(mutex);
      checks[i] = std::move(check);
      while (told < checks.size() && checks[told].done) on_done(checks[told++]);
    }
  };
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  if (jobs == 0) jobs = std::max(1, processors);
  std::vector<std::thread> others;
  for (int i = 1; i < jobs; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

}  // namespace substep::cli
