#include "core/lab/axes.hpp"

#include <array>

#include "core/model/methods.hpp"

namespace substep {

const char* axis_name(ErrorAxis axis) {
  constexpr std::array<const char*, kCountOf<ErrorAxis>> kNames{
      "largest distance from the reference [m]", "largest energy drift [J]",
      "largest joint gap [m]", "deepest overlap [m]"};
  return kNames[static_cast<std::size_t>(axis)];
}

const char* axis_name(CostAxis axis) {
  constexpr std::array<const char*, kCountOf<CostAxis>> kNames{
      "sub-steps per frame", "solver operations per frame", "median ms per frame, here"};
  return kNames[static_cast<std::size_t>(axis)];
}

const char* unit_of(ErrorAxis axis) { return axis == ErrorAxis::kEnergy ? "J" : "m"; }

double cost_of(const Result& result, CostAxis axis) {
  const Work& work = result.metrics.work;
  if (work.frames == 0) return 0.0;
  const auto frames = static_cast<double>(work.frames);
  switch (axis) {
    case CostAxis::kSubsteps:
      return static_cast<double>(work.substeps) / frames;
    case CostAxis::kOperations:
      return static_cast<double>(work.flops) / frames;
    case CostAxis::kTime:
      return result.metrics.timing.ms_median;
    case CostAxis::kCount:
      break;
  }
  return 0.0;
}

std::optional<double> error_of(const Result& result, ErrorAxis axis) {
  const Errors& errors = result.metrics.errors;
  if (!result.metrics.holds) return std::nullopt;
  switch (axis) {
    case ErrorAxis::kTrajectory:
      return errors.trajectory_peak;
    case ErrorAxis::kEnergy:
      return errors.energy_drift_peak;
    case ErrorAxis::kGap:
      return errors.joint_gap ? std::optional(errors.joint_gap->peak) : std::nullopt;
    case ErrorAxis::kPenetration:
      return errors.penetration ? std::optional(errors.penetration->peak) : std::nullopt;
    case ErrorAxis::kCount:
      break;
  }
  return std::nullopt;
}

ErrorAxis first_axis(const Scene& scene) {
  return scene.criteria.track ? ErrorAxis::kTrajectory : ErrorAxis::kEnergy;
}

}  // namespace substep
