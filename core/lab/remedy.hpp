#pragma once

#include <string>
#include <vector>

#include "core/model/settings.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// A change of settings that should help a run that failed.
struct Remedy {
  std::string text;  // "a smaller alpha, 0.05"
  std::string why;   // what speaks for it: "43 were wanted"; or ""
  Settings settings;
};

/// What would help, the most likely first: the implicit gyroscopic torque in place of the explicit
/// one, adaptive sub-steps where there are none, a larger cap where the cap was in force, the
/// direct solver in place of Gauss-Seidel, the soft drift law where impacts meet joints, a smaller
/// alpha.
/// @param last the report of the frame that failed  @return empty where nothing is left to turn, or
/// no setting would help
std::vector<Remedy> remedies(const Settings& settings, const FrameReport& last);

}  // namespace substep
