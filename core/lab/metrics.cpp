#include "core/lab/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/forces/applied_forces.hpp"
#include "core/lab/energy_scale.hpp"

namespace substep {
namespace {

constexpr std::size_t kWarmUp = 10;  // frames

/// Quantile: the upper one if between two values.
template <class T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return T{};
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::min(at, values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

PeakAndMedian peak_and_median(const std::vector<double>& values) {
  if (values.empty()) return {};
  return {*std::max_element(values.begin(), values.end()), quantile(values, 0.5)};
}

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

Measure::Measure(const Scene& scene, const State& state, const FrameReport& start,
                 const Reference& reference)
    : reference_(reference),
      verdict_(scene, state, start),
      energy_at_start_(start.energy),
      energy_(start.energy) {
  if (is_isolated(scene)) momentum_at_start_ = momenta_of(scene, state);
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
  n_.push_back(report.n_substeps);
  seconds_.push_back(seconds);
  add_times(report.times, stages_);
  constraint_.push_back(report.constraint_error);
  joint_gap_.push_back(report.joint_gap);
  penetration_.push_back(report.penetration);
  errors_.lcp_residual = std::max(errors_.lcp_residual, report.work.residual);
  energy_ = report.energy;
  errors_.energy_drift_peak =
      std::max(errors_.energy_drift_peak, std::abs(energy_ - energy_at_start_));
  const auto frame = static_cast<std::size_t>(report.frame);
  if (frame < reference_.track.size() && scene.criteria.track) {
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
  std::vector<double> warm = seconds_;
  if (warm.size() > 2 * kWarmUp) warm.erase(warm.begin(), warm.begin() + kWarmUp);
  timing.ms_median = 1e3 * quantile(warm, 0.5);
  timing.ms_p95 = 1e3 * quantile(warm, 0.95);
  const double wall = std::accumulate(warm.begin(), warm.end(), 0.0);
  if (wall > 0.0) timing.real_time_factor = static_cast<double>(warm.size()) * scene.frame / wall;
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
    m.errors.constraint = peak_and_median(constraint_);
    m.errors.joint_gap = peak_and_median(joint_gap_);
  }
  if (scene.effects.contact) m.errors.penetration = peak_and_median(penetration_);
  m.errors.energy_drift = energy_ - energy_at_start_;
  if (reference_.energy_scale >= kLeastEnergyScale) {
    m.errors.energy_drift_percent = 100.0 * m.errors.energy_drift / reference_.energy_scale;
  }
  if (!n_.empty()) {
    m.work.n_min = *std::min_element(n_.begin(), n_.end());
    m.work.n_median = quantile(n_, 0.5);
    m.work.n_max = *std::max_element(n_.begin(), n_.end());
  }
  if (!m.holds) {  // the distance from the reference is meaningless
    m.errors.trajectory_peak.reset();
    m.errors.trajectory_final.reset();
  }
  return m;
}

}  // namespace substep
