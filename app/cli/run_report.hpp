#pragma once

#include <cstdint>
#include <string>

#include "core/lab/metrics.hpp"

namespace substep::cli {

/// Accumulates the values in the summary of a run that are not among its metrics.
class RunReport {
 public:
  RunReport(const Scene& scene, const FrameReport& start);

  void add(const FrameReport& report);

  /// A one-line progress message for a terminal.
  [[nodiscard]] std::string progress(std::int64_t frames) const;
  /// A summary of the whole run in a few lines, each ended by a line feed.
  [[nodiscard]] std::string summary(const Metrics& metrics) const;

 private:
  [[nodiscard]] std::string energy_text() const;

  const Scene& scene_;
  double energy_at_start_;  // [J]
  FrameReport last_;
  std::int64_t capped_frames_ = 0;
  double substeps_of_a_body_ = 0.0;
  int most_asleep_ = 0;
  int lowered_ = 0;
  double lowered_to_ = 1.0;
  bool has_islands_ = false;
};

/// "bpp, adaptive, alpha 0.1, per frame, euler": the settings relevant to the mode.
std::string settings_line(const Settings& settings);

}  // namespace substep::cli
