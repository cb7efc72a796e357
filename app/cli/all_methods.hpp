#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/lab/experiment_run.hpp"
#include "core/lab/hold_search.hpp"
#include "core/lab/survey.hpp"

namespace substep::cli {

// All with progress on a terminal; a signal cancels them.

/// Runs all methods on a scene.
/// @param seconds duration of each run [s]
/// @param defaults also the default settings, along alpha
/// @return the results in the order of default_sweep(), independent of threads; empty if cancelled
std::optional<std::vector<Result>> run_all_methods(const std::shared_ptr<const Scene>& scene,
                                                   double seconds, int jobs,
                                                   const Reference& reference, bool defaults);

/// Runs experiments of a scene. @param reference null: it is found first
/// @return results in their order; empty if cancelled
std::optional<std::vector<Result>> run_experiments(const std::shared_ptr<const Scene>& scene,
                                                   std::vector<Experiment> experiments, int jobs,
                                                   const Reference* reference = nullptr);

/// The reference, refined up to an uncertainty [m]; empty if cancelled.
std::optional<Reference> find_reference(const std::shared_ptr<const Scene>& scene, double seconds,
                                        double required);

/// @return false if cancelled
bool complete(Survey& survey, const Scene& scene);
bool complete(HoldSearch& search, const Scene& scene);

}  // namespace substep::cli
