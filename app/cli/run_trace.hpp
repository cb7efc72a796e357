#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/lab/experiment.hpp"

namespace substep::cli {

/// Time series of a run, one value per frame, beginning with the start.
struct RunTrace {
  std::vector<double> time;              // [s]
  std::vector<double> substeps;          // of the frame that ends at that time [-]
  std::vector<double> kinetic;           // [J]
  std::vector<double> energy;            // [J]
  std::vector<double> constraint_error;  // [m, rad]
  std::vector<double> joint_gap;         // [m]
  std::vector<double> height;            // of the tracked body's centre [m]
  bool holds = true;
  double failed_at = 0.0;  // [s]
  std::string verdict;

  [[nodiscard]] double total_substeps() const;
};

/// Runs for the duration or until the verdict fails.
RunTrace trace_run(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                   double duration);

}  // namespace substep::cli
