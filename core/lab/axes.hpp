#pragma once

#include <cstdint>
#include <optional>

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

/// The primary error of a scene: the path of its tracked body, else energy.
ErrorAxis first_axis(const Scene& scene);

}  // namespace substep
