#include "core/lab/survey.hpp"

#include <utility>

#include "core/lab/experiment.hpp"
#include "core/lab/reference.hpp"
#include "core/lab/slice.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr int kSubsteps = 32;  // per frame: coarser than a reference, finer than most methods

}  // namespace

Survey::Survey(std::shared_ptr<const Scene> scene, double duration, const Budget& budget)
    : scene_(not_null(std::move(scene))),
      simulator_(scene_),
      start_(simulator_.state()),
      frames_(frames_of(*scene_, duration)) {
  simulator_.set_settings(reference_settings(*scene_, kSubsteps));
  simulator_.set_budget(budget);
  simulator_.set_measures({.energies = false, .errors = false, .stages = false});
}

bool Survey::advance() {
  if (simulator_.state().frame >= frames_) return false;
  const FrameReport report = simulator_.step_some(kPartWork);
  if (simulator_.substeps_left() > 0) return true;
  if (report.status != StepStatus::kOk) return false;
  touches_ = touches_ || report.work.rows.contact > 0;
  for (std::size_t i = 0; i < scene_->bodies.size(); ++i) {
    if (scene_->bodies[i].is_static) continue;
    const double distance = (simulator_.state().x[i] - start_.x[i]).norm();
    if (!(distance > distance_)) continue;
    distance_ = distance;
    farthest_ = static_cast<int>(i);
  }
  return simulator_.state().frame < frames_;
}

}  // namespace substep
