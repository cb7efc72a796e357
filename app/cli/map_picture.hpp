#pragma once
// The stability maps as one picture.

#include <string>
#include <vector>

#include "core/model/settings.hpp"

namespace substep::cli {

/// Result of one run of a map.
struct MapCell {
  std::string map;     // the parameter varied
  std::string label;   // its label
  double value = 0.0;  // value of the parameter
  double alpha = 0.0;
  SolverKind solver{};
  bool holds = false;
  double seconds = 0.0;  // simulated time until the end or the failure [s]
  int n_median = 0;      // per frame
  int n_max = 0;
  std::int64_t substeps = 0;
};

/// An SVG: a column per map, a row per solver; each cell shows the median number of sub-steps per
/// frame, or the time of failure.
std::string map_picture(const std::vector<MapCell>& cells);

}  // namespace substep::cli
