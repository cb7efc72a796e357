#include "core/lab/axes.hpp"

namespace substep {

const char* axis_name(ErrorAxis axis) {
  switch (axis) {
    case ErrorAxis::kTrajectory:
      return "largest distance from the reference [m]";
    case ErrorAxis::kEnergy:
      return "largest energy drift [J]";
    case ErrorAxis::kGap:
      return "largest joint gap [m]";
    case ErrorAxis::kPenetration:
      return "deepest overlap [m]";
    case ErrorAxis::kCount:
      break;
  }
  return "";
}

const char* axis_name(CostAxis axis) {
  switch (axis) {
    case CostAxis::kSubsteps:
      return "sub-steps per frame";
    case CostAxis::kOperations:
      return "solver operations per frame";
    case CostAxis::kTime:
      return "median ms per frame, here";
    case CostAxis::kCount:
      break;
  }
  return "";
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
