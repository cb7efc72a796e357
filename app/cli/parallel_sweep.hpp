#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/lab/sweep.hpp"

namespace substep::cli {

struct ParallelSweep {
  std::shared_ptr<const Scene> scene;
  std::vector<Experiment> experiments;
  int jobs = 1;
  const Reference* reference = nullptr;  // of the scene; null: it is found first
  /// Called from any thread as runs end, with the index of the experiment. @return false to stop
  /// the sweep
  std::function<bool(std::size_t, const Result&)> on_result;
  /// Called periodically from the first thread with the completed share, 0 to 1.
  std::function<void(double)> on_progress;
};

/// Runs the experiments on `jobs` threads, the longest first. A signal stops it within a frame.
/// @return false if cancelled or stopped
bool run_sweep(const ParallelSweep& sweep);

}  // namespace substep::cli
