#pragma once

#include <cstdint>
#include <string>

#include "core/model/settings.hpp"

namespace substep {

/// The error of a run that is considered.
enum class ErrorAxis : std::uint8_t { kTrajectory, kEnergy, kGap, kPenetration, kCount };

/// The cheapest settings within an error limit, found by a sweep over a scene.
struct Recommended {
  Settings settings;
  ErrorAxis of = ErrorAxis::kTrajectory;
  double within = 1e-3;     // error limit [m, J]
  double reached = 0.0;     // error of its run, at most `within` [m, J]
  double operations = 0.0;  // of the solver, per frame [-]
  double seconds = 10.0;    // simulated time of every run of the sweep [s]
  std::string why;          // comparison with the other runs, for display

  friend bool operator==(const Recommended&, const Recommended&) = default;
};

}  // namespace substep
