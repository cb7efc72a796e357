#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep::cli {

/// Runs all methods on a scene, with progress on a terminal.
/// @param seconds duration of each run [s]
/// @return the results in the order of default_sweep(), independent of threads; empty if cancelled
std::optional<std::vector<Result>> run_all_methods(const std::shared_ptr<const Scene>& scene,
                                                   double seconds, int jobs);

/// Runs experiments of a scene. @return results in their order; empty if cancelled
std::optional<std::vector<Result>> run_experiments(const std::shared_ptr<const Scene>& scene,
                                                   std::vector<Experiment> experiments, int jobs);

}  // namespace substep::cli
