#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep::cli {

/// Runs all methods over a scene as it stands, with progress on a terminal.
/// @param seconds that each run takes [s]
/// @return the results in the order of default_sweep(), so that ties do not hang on threads;
/// nothing where it was cancelled
std::optional<std::vector<Result>> run_all_methods(const std::shared_ptr<const Scene>& scene,
                                                   double seconds, int jobs,
                                                   const std::atomic<bool>& cancelled);

/// Runs these experiments of a scene, no two of them the same. @return results in their order,
/// nothing where it was cancelled
std::optional<std::vector<Result>> run_experiments(const std::shared_ptr<const Scene>& scene,
                                                   std::vector<Experiment> experiments, int jobs,
                                                   const std::atomic<bool>& cancelled);

}  // namespace substep::cli
