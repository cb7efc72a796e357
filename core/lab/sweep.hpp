#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

struct SweepPoint {
  Settings settings;
  double load = 1.0;  // Experiment::load
};

/// The runs that show error against cost for a scene: every mode with the direct solver and with
/// PGS, with Euler and leapfrog; with the direct solver `adaptive` per sub-step too; XPBD, Newton
/// and small steps; and if applicable to the scene the second-order drift correction, Störmer's
/// formula, the exact contact block, refinements, the explicit gyroscopic torque and islands. Each
/// along its own parameter; and, for the map of stability, constant N and adaptive under other
/// loads if the scene has different masses. Other settings are the scene's own.
std::vector<SweepPoint> default_sweep(const Scene& scene);

/// The settings that default_sweep() gives every run itself, by their names in setting_fields():
/// their values in the scene have no effect on it.
std::span<const std::string_view> swept_settings();

/// Adds the default settings along alpha. They combine what default_sweep() varies one by one.
void append_defaults(std::vector<SweepPoint>& points);

/// Settings of the curve of the paper's method, except alpha: the direct solver, Euler, N decided
/// once per frame by alpha alone, with a cap too large to matter; other settings of the scene are
/// reset as in a sweep.
Settings paper_settings(const Scene& scene);

/// The alphas of the map of stability, descending.
std::span<const double> map_alphas();

/// Estimated sub-steps of a run, weighted by their cost: for progress bars only.
double expected_work(const Scene& scene, const Experiment& experiment);

/// A sweep in slices, for a responsive page without threads.
class Sweep {
 public:
  /// @param budget of each frame
  Sweep(std::shared_ptr<const Scene> scene, std::vector<Experiment> experiments,
        const Budget& budget = {});

  /// Continues for about this long, at least a part of one frame. @return false when done
  bool advance(double seconds);
  [[nodiscard]] bool done() const { return next_ == experiments_.size() && !run_; }
  [[nodiscard]] double progress() const;  ///< 0 to 1
  [[nodiscard]] const std::vector<Result>& results() const { return results_; }
  [[nodiscard]] const std::vector<Experiment>& experiments() const { return experiments_; }
  /// Nothing until it is known.
  [[nodiscard]] const Reference* reference() const { return reference_.get(); }

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
  double work_ = 0.0;       // estimate for all runs
  double work_done_ = 0.0;  // of completed runs
};

}  // namespace substep
