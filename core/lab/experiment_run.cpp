#include "core/lab/experiment_run.hpp"

#include <chrono>
#include <memory>
#include <utility>

#include "core/lab/slice.hpp"

namespace substep {

ExperimentRun::ExperimentRun(const Scene& scene, Experiment experiment, const Reference& reference,
                             const Budget& budget)
    : experiment_(std::move(experiment)),
      simulator_(
          std::make_shared<const Scene>(start_of(scene, experiment_.load, experiment_.seed))),
      report_(simulator_.observe()),
      reference_(experiment_.load == 1.0 ? reference : no_reference()),
      measure_(simulator_.scene(), simulator_.state(), report_, reference_),
      frames_(frames_of(simulator_.scene(), experiment_.duration)) {
  simulator_.set_settings(experiment_.settings);
  simulator_.set_budget(budget);
}

bool ExperimentRun::advance() {
  const auto is_over = [this] {
    return simulator_.state().frame >= frames_ || !measure_.verdict().holds();
  };
  if (is_over()) return false;
  const auto before = std::chrono::steady_clock::now();
  const FrameReport report = simulator_.step_some(kPartWork);
  wall_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  if (simulator_.substeps_left() > 0) return true;
  report_ = report;
  measure_.add(simulator_.scene(), simulator_.state(), report_, std::exchange(wall_, 0.0));
  return !is_over();
}

double ExperimentRun::progress() const {
  return frames_ > 0 ? static_cast<double>(simulator_.state().frame) / static_cast<double>(frames_)
                     : 1.0;
}

Result ExperimentRun::result() const {
  return {experiment_, measure_.metrics(simulator_.scene(), simulator_.state()), reference_};
}

}  // namespace substep
