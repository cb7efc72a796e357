#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/lab/experiment_run.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// Unit of a run's cost, per frame.
enum class CostAxis : std::uint8_t { kSubsteps, kOperations, kTime, kCount };

/// "largest distance from the reference [m]"
const char* axis_name(ErrorAxis axis);
const char* axis_name(CostAxis axis);
/// "m" or "J"
const char* unit_of(ErrorAxis axis);

double cost_of(const Result& result, CostAxis axis);
/// Nothing if the scene has no such error, or the run failed.
std::optional<double> error_of(const Result& result, ErrorAxis axis);

/// What changes the energy of a scene in the true motion: "friction", "impacts" that do not
/// restore all speed, or "a constant torque"; "" if nothing does. A change of energy is then no
/// error. What a method adds or damps is one.
/// @param touches false: no contact closes, so that nothing acts there
std::string energy_changes_by(const Scene& scene, bool touches = true);

/// The primary error of a scene: the path of its tracked body, else energy where the true motion
/// keeps it, else gaps of joints, else overlaps.
ErrorAxis first_axis(const Scene& scene);

}  // namespace substep
