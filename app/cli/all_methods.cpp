#include "app/cli/all_methods.hpp"

#include <string>
#include <utility>

#include "app/cli/cancel.hpp"
#include "app/cli/output.hpp"
#include "app/cli/parallel_sweep.hpp"
#include "app/cli/progress_line.hpp"
#include "core/io/all_methods.hpp"
#include "core/model/format_text.hpp"

namespace substep::cli {
namespace {

/// Calls advance() until it returns false. @param text of the progress so far
/// @return false if cancelled
template <class Advance, class Text>
bool complete_with(const Advance& advance, const Text& text) {
  ProgressLine progress(stderr_is_terminal());
  while (!cancel_on_signal() && advance()) {
    if (progress.due()) progress.show(text());
  }
  progress.clear();
  return !cancel_on_signal();
}

}  // namespace

std::optional<std::vector<Result>> run_experiments(const std::shared_ptr<const Scene>& scene,
                                                   std::vector<Experiment> experiments, int jobs,
                                                   const Reference* reference) {
  ParallelSweep sweep{scene, std::move(experiments), jobs, reference, {}, {}};
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
                                                   double seconds, int jobs,
                                                   const Reference& reference, bool defaults) {
  return run_experiments(scene, all_methods(*scene, seconds, defaults), jobs, &reference);
}

std::optional<Reference> find_reference(const std::shared_ptr<const Scene>& scene, double seconds,
                                        double required) {
  ReferenceRun run(scene, seconds, {}, required);
  const bool complete =
      complete_with([&] { return run.advance(); },
                    [&] {
                      return format_text("%s: %3.0f %% of the reference, %s", scene->name.c_str(),
                                         100.0 * run.progress(), run.source().c_str());
                    });
  return complete ? std::optional(run.reference()) : std::nullopt;
}

bool complete(Survey& survey, const Scene& scene) {
  return complete_with([&] { return survey.advance(); },
                       [&] { return scene.name + ": looking for the body to compare"; });
}

bool complete(HoldSearch& search, const Scene& scene) {
  constexpr double kSlice = 0.05;  // [s]
  return complete_with([&] { return search.advance(kSlice); },
                       [&] {
                         return format_text("%s: %3.0f %% of whole run %zu", scene.name.c_str(),
                                            100.0 * search.progress(), search.failed().size() + 1);
                       });
}

}  // namespace substep::cli
