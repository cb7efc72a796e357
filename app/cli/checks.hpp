#pragma once
// Runs with an expected verdict, on several threads.

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "core/lab/metrics.hpp"
#include "core/lab/verdict_table.hpp"

namespace substep::cli {

/// A run and its result.
struct Check {
  std::shared_ptr<const Scene> scene;
  VerdictCell cell;
  int seed = 0;

  bool done = false;
  Judgement judgement{};
  Metrics metrics{};
  double time = 0.0;     // simulated [s]
  double seconds = 0.0;  // wall time [s]
};

inline const std::atomic<bool> kNeverCancelled{false};

/// @param jobs parallel runs; 0: one per processor
/// @param on_done called in order, once a run and those before it have finished
/// @return false if cancelled; finished runs are still reported
bool run_checks(std::vector<Check>& checks, int jobs,
                const std::function<void(const Check&)>& on_done,
                const std::atomic<bool>& cancelled = kNeverCancelled);

}  // namespace substep::cli
