#pragma once
// The stability maps as one picture.

#include <string>
#include <vector>

#include "app/cli/checks.hpp"

namespace substep::cli {

/// One run of a map.
struct MapCell {
  std::string map;             // the parameter varied
  std::string label;           // its label
  double value = 0.0;          // value of the parameter
  const Check* run = nullptr;  // once it is done
};

/// An SVG: a column per map, a row per solver; each cell shows the median number of sub-steps per
/// frame, or the time of failure.
std::string map_picture(const std::vector<MapCell>& cells);

}  // namespace substep::cli
