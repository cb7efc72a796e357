#pragma once

#include <cstdint>
#include <string>

#include "core/model/settings.hpp"

namespace substep {

/// Which error of a run is looked at.
enum class ErrorAxis : std::uint8_t { kTrajectory, kEnergy, kGap, kPenetration, kCount };

/// The setting that a sweep over a scene found cheapest within a wanted error.
struct Recommended {
  Settings settings;
  ErrorAxis of = ErrorAxis::kTrajectory;
  double within = 1e-3;     // wanted at most [m, J]
  double reached = 0.0;     // by its own run, no more than that [m, J]
  double operations = 0.0;  // of the solver, in a frame [-]
  double seconds = 10.0;    // simulated by every run of the sweep [s]
  std::string why;          // how it stands beside the others, for people

  friend bool operator==(const Recommended&, const Recommended&) = default;
};

}  // namespace substep
