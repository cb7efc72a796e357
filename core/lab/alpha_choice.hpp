#pragma once

#include <atomic>
#include <optional>

#include "core/lab/axes.hpp"

namespace substep {

/// An alpha (Eq. 5) that was chosen by what came of it.
struct AlphaChoice {
  double alpha = 0.0;  // [-]
  Result result;       // of the whole run with it
};

inline constexpr double kLeastAlpha = 1e-4;  // that is looked for [-]

// Both halve an interval of alpha over whole runs until its ends are within 2 %, and take for
// granted that a smaller alpha costs more and errs less. The choice itself was run: it keeps what
// it is chosen for. Nothing where no alpha from kLeastAlpha to 1 does.

/// The largest alpha whose run holds with an error of no more than this.
/// @param experiment whose other settings stand; its mode reads alpha
/// @param reference of the scene; outlives the call
std::optional<AlphaChoice> largest_alpha_within(const Scene& scene, const Experiment& experiment,
                                                const Reference& reference, ErrorAxis axis,
                                                double error, const std::atomic<bool>& cancelled);

/// The smallest alpha whose frames cost no more than this.
std::optional<AlphaChoice> smallest_alpha_within(const Scene& scene, const Experiment& experiment,
                                                 const Reference& reference, CostAxis axis,
                                                 double cost, const std::atomic<bool>& cancelled);

}  // namespace substep
