#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/lab/experiment.hpp"

namespace substep::cli {

/// What a run does over time, frame by frame, the start first.
struct RunTrace {
  std::vector<double> time;              // [s]
  std::vector<double> substeps;          // of the frame that ends then [-]
  std::vector<double> kinetic;           // [J]
  std::vector<double> energy;            // [J]
  std::vector<double> constraint_error;  // [m, rad]
  std::vector<double> joint_gap;         // [m]
  std::vector<double> height;            // of the tracked body's centre [m]
  bool holds = true;
  double failed_at = 0.0;  // [s]
  std::string verdict;
  double seconds = 0.0;  // wall time [s]

  [[nodiscard]] double total_substeps() const;
};

/// Runs until the time is over or the verdict falls.
RunTrace trace_run(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                   double duration);

}  // namespace substep::cli
