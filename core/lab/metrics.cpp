#include "core/lab/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/forces/applied_forces.hpp"
#include "core/lab/energy_scale.hpp"

namespace substep {
namespace {

constexpr std::size_t kWarmUp = 10;  // frames

/// True if no external forces act on the moving bodies.
bool is_isolated(const Scene& scene) {
  if (has_applied_forces(scene.effects)) return false;
  for (const Joint& joint : scene.joints) {
    if (is_fixed(scene, base(joint).a) || is_fixed(scene, base(joint).b)) return false;
  }
  return !scene.effects.contact || std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                                [](const Body& b) { return b.is_static; });
}

void raise_to(std::optional<double>& largest, double value) {
  largest = std::max(largest.value_or(0.0), value);
}

void add_times(const StageTimes& frame, StageTimes& sum) {
  for (double StageTimes::*stage :
       {&StageTimes::joints, &StageTimes::contact, &StageTimes::friction, &StageTimes::grab,
        &StageTimes::mass, &StageTimes::solve, &StageTimes::stiffness, &StageTimes::integrate,
        &StageTimes::total}) {
    sum.*stage += frame.*stage;
  }
}

}  // namespace

void Measure::Spread::add(double value) {
  peak = sample.values().empty() ? value : std::max(peak, value);
  sample.add(value);
}

PeakAndMedian Measure::Spread::of_all() const { return {peak, sample.quantile(0.5)}; }

Measure::Measure(const Scene& scene, const State& state, const FrameReport& start,
                 const Reference& reference)
    : reference_(reference),
      verdict_(scene, state, start),
      energy_at_start_(start.energy),
      energy_(start.energy) {
  if (!verdict_.refused() && is_isolated(scene)) momentum_at_start_ = momenta_of(scene, state);
}

void Measure::add(const Scene& scene, const State& state, const FrameReport& report,
                  double seconds) {
  verdict_.add(scene, state, report);
  ++work_.frames;
  work_.substeps += report.n_substeps + report.n_discarded;
  work_.solves += report.work.solves;
  work_.row_updates += report.work.row_updates;
  work_.factorisations += report.work.factorisations;
  work_.pivots += report.work.pivots;
  work_.unsettled += report.work.unsettled;
  work_.unsolved += report.work.unsolved;
  work_.flops += report.work.flops;
  work_.visits += report.visits;
  work_.rows += report.work.rows;
  work_.criterion += report.criterion;
  work_.n_min = work_.frames == 1 ? report.n_substeps : std::min(work_.n_min, report.n_substeps);
  work_.n_max = std::max(work_.n_max, report.n_substeps);
  n_.add(report.n_substeps);
  if (first_seconds_.size() < kWarmUp) {
    first_seconds_.push_back(seconds);
  } else {
    seconds_.add(seconds);
    wall_ += seconds;
  }
  add_times(report.times, stages_);
  constraint_.add(report.constraint_error);
  joint_gap_.add(report.joint_gap);
  penetration_.add(report.penetration);
  errors_.lcp_residual = std::max(errors_.lcp_residual, report.work.residual);
  energy_ = report.energy;
  errors_.energy_drift_peak =
      std::max(errors_.energy_drift_peak, std::abs(energy_ - energy_at_start_));
  const auto frame = static_cast<std::size_t>(report.frame);
  if (frame < reference_.track.size() && scene.criteria.track && !verdict_.refused()) {
    const Vec3& x = state.x[index(*scene.criteria.track)];
    errors_.trajectory_final = (x - reference_.track[frame]).norm();
    raise_to(errors_.trajectory_peak, *errors_.trajectory_final);
  }
  if (momentum_at_start_) {
    const Momenta now = momenta_of(scene, state);
    raise_to(errors_.linear_momentum_drift, (now.linear - momentum_at_start_->linear).norm());
    raise_to(errors_.angular_momentum_drift, (now.angular - momentum_at_start_->angular).norm());
  }
}

Timing Measure::timing(const Scene& scene) const {
  Timing timing;
  timing.stages = stages_;
  BoundedSample warm = seconds_;
  double wall = wall_;
  auto frames = static_cast<std::size_t>(work_.frames) - first_seconds_.size();
  if (frames <= kWarmUp) {  // too few to leave any out
    for (const double seconds : first_seconds_) warm.add(seconds);
    wall += std::accumulate(first_seconds_.begin(), first_seconds_.end(), 0.0);
    frames += first_seconds_.size();
  }
  timing.ms_median = 1e3 * warm.quantile(0.5);
  timing.ms_p95 = 1e3 * warm.quantile(0.95);
  if (wall > 0.0) timing.real_time_factor = static_cast<double>(frames) * scene.frame / wall;
  return timing;
}

Metrics Measure::metrics(const Scene& scene, const State& state) const {
  Metrics m;
  m.errors = errors_;
  m.work = work_;
  m.timing = timing(scene);
  m.holds = verdict_.holds();
  m.failed_at = verdict_.failed_at();
  m.verdict = verdict_.text();
  m.hash = state_hash(state);
  if (scene.effects.joints) {
    m.errors.constraint = constraint_.of_all();
    m.errors.joint_gap = joint_gap_.of_all();
  }
  if (scene.effects.contact) m.errors.penetration = penetration_.of_all();
  m.errors.energy_drift = energy_ - energy_at_start_;
  if (reference_.energy_scale >= kLeastEnergyScale) {
    m.errors.energy_drift_percent = 100.0 * m.errors.energy_drift / reference_.energy_scale;
  }
  m.work.n_median = static_cast<int>(n_.quantile(0.5));
  if (!m.holds) {  // the distance from the reference is meaningless
    m.errors.trajectory_peak.reset();
    m.errors.trajectory_final.reset();
  }
  return m;
}

}  // namespace substep
