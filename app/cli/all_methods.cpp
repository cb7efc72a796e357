#include "app/cli/all_methods.hpp"

#include <set>
#include <string>
#include <utility>

#include "app/cli/output.hpp"
#include "app/cli/parallel_sweep.hpp"
#include "app/cli/progress_line.hpp"
#include "core/io/experiment.hpp"
#include "core/model/format_text.hpp"

namespace substep::cli {

std::optional<std::vector<Result>> run_experiments(const std::shared_ptr<const Scene>& scene,
                                                   std::vector<Experiment> experiments, int jobs) {
  ParallelSweep sweep{scene, std::move(experiments), jobs, {}, {}};
  std::vector<Result> results(sweep.experiments.size());
  sweep.on_result = [&](std::size_t i, const Result& result) {
    results[i] = result;
    return true;
  };
  ProgressLine progress(stderr_is_terminal());
  sweep.on_progress = [&](double share) {
    if (!progress.due()) return;
    progress.show(format_text("%s: %3.0f %% of all methods", scene->name.c_str(), 100.0 * share));
  };
  const bool complete = run_sweep(sweep);
  progress.clear();
  return complete ? std::optional(std::move(results)) : std::nullopt;
}

std::optional<std::vector<Result>> run_all_methods(const std::shared_ptr<const Scene>& scene,
                                                   double seconds, int jobs) {
  Experiment plain = experiment_of(*scene, scene->settings);
  plain.duration = seconds;
  std::vector<Experiment> experiments;
  std::set<std::string> known;
  for (const SweepPoint& point : default_sweep(*scene)) {
    if (point.load != 1.0) continue;
    Experiment experiment = plain;
    experiment.settings = point.settings;
    if (known.insert(experiment_id(experiment)).second) experiments.push_back(experiment);
  }
  return run_experiments(scene, std::move(experiments), jobs);
}

}  // namespace substep::cli
