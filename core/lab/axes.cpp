#include "core/lab/axes.hpp"

#include <algorithm>
#include <array>

#include "core/forces/applied_forces.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/methods.hpp"

namespace substep {
namespace {

/// True if two bodies that can collide are both of this kind.
template <class Kind>
bool is_pair(const Scene& scene, const Kind& kind) {
  const auto count = [&](bool moving_only) {
    return std::count_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) {
      return body.collides && !(moving_only && body.is_static) && kind(body);
    });
  };
  return count(false) > 1 && count(true) > 0;
}

}  // namespace

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

std::string energy_changes_by(const Scene& scene, bool touches) {
  const Effects& effects = scene.effects;
  const bool contact = effects.contact && touches;
  if (contact && effects.friction &&
      is_pair(scene, [](const Body& body) { return body.friction > 0.0; })) {
    return "friction";
  }
  if (contact && is_pair(scene, [&](const Body& body) {
        return !effects.restitution || body.restitution < 1.0;
      })) {
    return "impacts";
  }
  if (effects.limits && std::any_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& j) {
        const Limit* limit = limit_of(j);
        return limit != nullptr && (!effects.restitution || limit->restitution < 1.0);
      })) {
    return "limits";
  }
  if (effects.motors) return "motors";
  if (effects.drives) return "drives";
  if (effects.joint_friction) return "joint friction";
  return has_torque(scene) ? "a constant torque" : "";
}

ErrorAxis first_axis(const Scene& scene) {
  if (scene.criteria.track) return ErrorAxis::kTrajectory;
  if (energy_changes_by(scene).empty()) return ErrorAxis::kEnergy;
  if (scene.effects.joints) return ErrorAxis::kGap;
  return scene.effects.contact ? ErrorAxis::kPenetration : ErrorAxis::kEnergy;
}

}  // namespace substep
