#pragma once
// Runs a scene and records the quantities that the tests of physics and of the paper's claims need.

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/lab/verdict.hpp"
#include "core/sim/simulator.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {

inline constexpr double kGravity = 9.81;  // [m/s^2]
inline constexpr SolverKind kAllSolvers[] = {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kXpbd,
                                             SolverKind::kNewton};

inline std::shared_ptr<const Scene> shared(const Scene& scene) {
  return std::make_shared<const Scene>(scene);
}
inline Simulator simulator_of(std::shared_ptr<const Scene> scene, const Settings& settings) {
  Simulator simulator(std::move(scene));
  simulator.set_settings(settings);
  if (simulator.state().x.empty()) throw std::invalid_argument("a scene that cannot be simulated");
  return simulator;
}
inline Simulator simulator_of(const Scene& scene, const Settings& settings) {
  return simulator_of(shared(scene), settings);
}

struct Outcome {
  bool holds = true;
  double failed_at = 0.0;  // [s]
  std::string verdict;
  std::vector<int> n;                    // sub-steps of every frame
  std::vector<Vec3> track;               // of the scene's tracked body, from the start on [m]
  std::vector<double> constraint_error;  // of every frame
  double joint_gap = 0.0;                // largest [m]
  double energy_start = 0.0;             // [J]
  double energy_end = 0.0;               // [J]
  double residual = 0.0;                 // largest of the last sub-steps of all frames
  std::int64_t unsolved = 0;
  State end;

  [[nodiscard]] std::int64_t substeps() const {
    std::int64_t sum = 0;
    for (const int k : n) sum += k;
    return sum;
  }
  [[nodiscard]] int n_min() const { return *std::min_element(n.begin(), n.end()); }
  [[nodiscard]] int n_max() const { return *std::max_element(n.begin(), n.end()); }
  [[nodiscard]] int n_median() const { return median(n); }
  template <class T>
  static T median(std::vector<T> values) {
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  }
};

using EveryFrame = std::function<void(const Simulator&, const FrameReport&)>;

/// Runs to the end time, or until the run fails.
/// @param stop_when_failed false: a failed run continues to the end time
inline Outcome run(const Scene& scene, const Settings& settings, double seconds,
                   const EveryFrame& every_frame = {}, bool stop_when_failed = true) {
  const auto held = shared(scene);
  Simulator simulator = simulator_of(held, settings);
  Outcome out;
  const FrameReport start = simulator.observe();
  Verdict verdict(*held, simulator.state(), start);
  out.energy_start = start.energy;
  const auto tracked = static_cast<std::size_t>(scene.criteria.track.value_or(0));
  out.track.push_back(simulator.state().x[tracked]);
  const auto frames = static_cast<int>(seconds / scene.frame + 0.5);
  for (int frame = 0; frame < frames; ++frame) {
    const FrameReport report = simulator.step();
    verdict.add(*held, simulator.state(), report);
    out.n.push_back(report.n_substeps);
    out.track.push_back(simulator.state().x[tracked]);
    out.constraint_error.push_back(report.constraint_error);
    keep_largest(out.joint_gap, report.joint_gap);
    out.energy_end = report.energy;
    keep_largest(out.residual, report.work.residual);
    out.unsolved += report.work.unsolved;
    if (every_frame) every_frame(simulator, report);
    if (report.status != StepStatus::kOk || (stop_when_failed && !verdict.holds())) break;
  }
  out.holds = verdict.holds();
  out.failed_at = verdict.failed_at();
  out.verdict = verdict.text();
  out.end = simulator.state();
  return out;
}

}  // namespace substep::test
