#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

struct SweepPoint {
  Settings settings;
  double load = 1.0;  // Experiment::load
};

/// The runs that show what accuracy costs on a scene: every mode with the direct solver and with
/// PGS, with Euler and leapfrog; with the direct solver `adaptive` per sub-step too; XPBD, Newton
/// and small steps; and where the scene has use for them the drift correction of second order,
/// Störmer's formula, the exact contact block, refinements, the explicit gyroscopic torque and
/// islands. Each along its own
/// parameter; and, for a map of where they hold, constant N and adaptive under other loads where
/// bodies of different mass meet. Other settings stay as the scene has them of its own.
std::vector<SweepPoint> default_sweep(const Scene& scene);

/// Of the curve of the paper's method, but for its alpha: the direct solver, Euler, N decided once
/// a frame by alpha alone, up to a cap that is out of its way; and what else a sweep sets aside of
/// a scene's own settings.
Settings paper_settings(const Scene& scene);

/// Sub-steps a run is likely to take, weighted by what one costs: for progress bars only.
double expected_work(const Scene& scene, const Experiment& experiment);

/// A sweep in slices, for a page that has no threads and must stay alive.
class Sweep {
 public:
  /// @param budget of each frame
  Sweep(std::shared_ptr<const Scene> scene, std::vector<Experiment> experiments,
        const Budget& budget = {});

  /// Goes on for about that long, by a part of a frame of one run at least. @return false when done
  bool advance(double seconds);
  [[nodiscard]] bool done() const { return next_ == experiments_.size() && !run_; }
  [[nodiscard]] double progress() const;  ///< 0 to 1
  [[nodiscard]] const std::vector<Result>& results() const { return results_; }
  [[nodiscard]] const std::vector<Experiment>& experiments() const { return experiments_; }
  /// Nothing until it is found.
  [[nodiscard]] const Reference* reference() const;

 private:
  void advance_by_a_frame();

  std::shared_ptr<const Scene> scene_;
  std::vector<Experiment> experiments_;
  Budget budget_;
  std::optional<ReferenceRun> finding_reference_;
  std::unique_ptr<const Reference> reference_;
  std::unique_ptr<ExperimentRun> run_;
  std::size_t next_ = 0;
  std::vector<Result> results_;
  double work_ = 0.0;       // expected of all
  double work_done_ = 0.0;  // of the runs that are over
};

}  // namespace substep
