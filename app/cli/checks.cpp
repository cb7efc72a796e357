#include "app/cli/checks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

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

/// Starts count - 1 threads; fewer if the system has no more.
std::vector<std::thread> threads_of(std::size_t count, const std::function<void()>& work) {
  std::vector<std::thread> threads;
  try {
    while (threads.size() + 1 < count) threads.emplace_back(work);
  } catch (const std::system_error&) {
    // Continue with fewer.
  }
  return threads;
}

}  // namespace

bool run_checks(std::vector<Check>& checks, int jobs,
                const std::function<void(const Check&)>& on_done,
                const std::atomic<bool>& cancelled) {
  std::atomic<std::size_t> next{0};
  std::size_t reported = 0;
  std::mutex mutex;
  std::exception_ptr error;
  const auto one = [&](std::size_t i) {
    Check check = checks[i];
    if (!run(check, cancelled)) return;
    const std::lock_guard lock(mutex);
    checks[i] = std::move(check);
    while (reported < checks.size() && checks[reported].done) on_done(checks[reported++]);
    if (std::ferror(stdout) != 0) next = checks.size();  // the output is closed: stop
  };
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < checks.size() && !cancelled; i = next++) one(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      error = std::current_exception();
      next = checks.size();
    }
  };
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  if (jobs == 0) jobs = std::max(1, processors);
  std::vector<std::thread> others =
      threads_of(std::min(static_cast<std::size_t>(jobs), checks.size()), work);
  work();
  for (std::thread& other : others) other.join();
  if (error) std::rethrow_exception(error);
  for (; reported < checks.size(); ++reported) {  // finished after a cancelled one
    if (checks[reported].done) on_done(checks[reported]);
  }
  return !cancelled;
}

}  // namespace substep::cli
