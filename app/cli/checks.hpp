#pragma once
// Many runs, each beside what is expected of it, on several threads.

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/lab/metrics.hpp"
#include "core/lab/verdict_table.hpp"

namespace substep::cli {

/// A run and what came of it.
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

/// @param jobs runs at a time; 0: one for each processor
/// @param on_done called in order, as soon as a run and those before it are over
/// @return false where it was cancelled: the runs that were done are told all the same
bool run_checks(std::vector<Check>& checks, int jobs,
                const std::function<void(const Check&)>& on_done,
                const std::atomic<bool>& cancelled = kNeverCancelled);

}  // namespace substep::cli
