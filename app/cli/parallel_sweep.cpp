#include "app/cli/parallel_sweep.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <system_error>
#include <thread>

namespace substep::cli {
namespace {

/// The experiments by estimated cost, the most expensive first, so that the threads end at about
/// the same time.
std::vector<std::size_t> dearest_first(const ParallelSweep& sweep) {
  std::vector<std::size_t> order(sweep.experiments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return expected_work(*sweep.scene, sweep.experiments[a]) >
           expected_work(*sweep.scene, sweep.experiments[b]);
  });
  return order;
}

class Workers {
 public:
  explicit Workers(const ParallelSweep& sweep)
      : sweep_(sweep), order_(dearest_first(sweep)), done_(sweep.experiments.size()) {
    for (const Experiment& experiment : sweep.experiments) {
      longest_ = std::max(longest_, experiment.duration);
      work_ += expected_work(*sweep.scene, experiment);
    }
  }

  bool run() {
    reference_ = reference();
    if (!stopping()) {
      std::vector<std::thread> threads;
      try {
        for (int i = 0; i < sweep_.jobs; ++i) threads.emplace_back([this] { caught(); });
      } catch (const std::system_error&) {
        if (threads.empty()) caught();  // continue with fewer threads, or only this one
      }
      while (working_.load() > 0 || next_.load() < order_.size()) {
        if (stopping()) break;
        sweep_.on_progress(progress());
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
      for (std::thread& thread : threads) thread.join();
      if (error_) std::rethrow_exception(error_);
    }
    return !stopping();
  }

 private:
  [[nodiscard]] bool stopping() const { return failed_ || *sweep_.cancelled; }

  Reference reference() {
    ReferenceRun run(sweep_.scene, longest_);
    while (!stopping() && run.advance()) sweep_.on_progress(0.0);
    return stopping() ? Reference{} : run.reference();
  }

  /// Runs work(); stores an exception for the waiting thread.
  void caught() {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      error_ = std::current_exception();
      failed_ = true;
    }
  }

  void work() {
    ++working_;
    for (std::size_t i = next_++; i < order_.size() && !stopping(); i = next_++) {
      ExperimentRun run(*sweep_.scene, sweep_.experiments[order_[i]], reference_);
      while (!stopping() && run.advance()) done_[i] = run.progress();
      if (stopping()) break;
      done_[i] = 1.0;
      if (!sweep_.on_result(run.result())) failed_ = true;
    }
    --working_;
  }

  [[nodiscard]] double progress() const {
    double done = 0.0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      done += done_[i] * expected_work(*sweep_.scene, sweep_.experiments[order_[i]]);
    }
    return work_ > 0.0 ? done / work_ : 1.0;
  }

  const ParallelSweep& sweep_;
  std::vector<std::size_t> order_;
  std::vector<std::atomic<double>> done_;  // share of each run
  Reference reference_;
  double longest_ = 0.0;  // [s]
  double work_ = 0.0;
  std::atomic<std::size_t> next_{0};
  std::atomic<int> working_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr error_;  // protected by the mutex
};

}  // namespace

bool run_sweep(const ParallelSweep& sweep) {
  return sweep.experiments.empty() || Workers(sweep).run();
}

}  // namespace substep::cli
