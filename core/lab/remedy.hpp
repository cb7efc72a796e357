#pragma once

#include <string>
#include <vector>

#include "core/model/settings.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// A change of settings that should help a run that failed.
struct Remedy {
  std::string text;  // "a smaller alpha, 0.05"
  std::string why;   // the reason: "43 were required"; or ""
  Settings settings;
};

/// Suggestions, the most likely first: the implicit gyroscopic torque instead of the explicit one,
/// adaptive sub-steps if not used, a larger cap if it was reached, the direct solver instead of
/// Gauss-Seidel, the soft drift law for impacts on joints, a smaller alpha. @param last the report
/// of the failed frame @return empty if no setting would help
std::vector<Remedy> remedies(const Settings& settings, const FrameReport& last);

}  // namespace substep
