#pragma once
// The stability maps as one picture.

#include <string>
#include <vector>

#include "core/model/settings.hpp"

namespace substep::cli {

/// What came of one run of a map.
struct MapCell {
  std::string map;     // what is varied
  std::string label;   // the same for people
  double value = 0.0;  // of it
  double alpha = 0.0;
  SolverKind solver{};
  bool holds = false;
  double seconds = 0.0;  // that it ran, simulated [s]
  int n_median = 0;      // sub-steps a frame
  int n_max = 0;
  std::int64_t substeps = 0;
};

/// An SVG: a column for each map, a row for each solver; in each cell the median of the sub-steps a
/// frame, or when it failed.
std::string map_picture(const std::vector<MapCell>& cells);

}  // namespace substep::cli
