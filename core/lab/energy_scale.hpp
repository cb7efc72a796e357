#pragma once
// The reference energy for drift percentages.

#include <cmath>
#include <optional>

namespace substep {

/// Least energy that a percentage may refer to [J]. A scene at rest exchanges nothing but noise: a
/// card house has 20 µJ of kinetic energy and settles by 1 mJ, which is not "-5000 %".
inline constexpr double kLeastEnergyScale = 1e-3;

/// A kinetic energy is a valid scale only if it is this many times the drift: in a run with
/// spurious energy gain the kinetic energy is itself drift.
inline constexpr double kScaleOverDrift = 10.0;

/// The reference energy for the drift of a run.
/// @param stated by the scene, the energy that its motion exchanges [J]
/// @param kinetic the largest kinetic energy so far [J]
/// @param drift the largest change of the total energy so far, up or down [J]
/// @return nothing if there is no such energy: the drift is then given in joules only
inline std::optional<double> energy_scale(std::optional<double> stated, double kinetic,
                                          double drift) {
  const double scale = stated.value_or(kinetic);
  if (!std::isfinite(scale) || scale < kLeastEnergyScale) return std::nullopt;
  if (!stated && !(std::abs(drift) * kScaleOverDrift <= scale)) return std::nullopt;
  return scale;
}

/// A drift as a share of a scale [-]. Nothing if there is no scale or the drift exceeds it.
inline std::optional<double> energy_share(double drift, std::optional<double> scale) {
  if (!scale || !(std::abs(drift) <= *scale)) return std::nullopt;
  return drift / *scale;
}

}  // namespace substep
