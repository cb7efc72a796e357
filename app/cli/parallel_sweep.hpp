#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "core/lab/sweep.hpp"

namespace substep::cli {

struct ParallelSweep {
  std::shared_ptr<const Scene> scene;
  std::vector<Experiment> experiments;
  int jobs = 1;
  /// Called from any thread as runs end. @return false to stop the sweep
  std::function<bool(const Result&)> on_result;
  /// Called from the first thread every now and then with the share that is done, 0 to 1.
  std::function<void(double)> on_progress;
  /// The sweep stops within a frame once this is set.
  const std::atomic<bool>* cancelled = nullptr;
};

/// Runs the experiments, the longest first, on that many threads.
/// @return false where it was cancelled or stopped
bool run_sweep(const ParallelSweep& sweep);

}  // namespace substep::cli
