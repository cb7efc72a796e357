#pragma once

#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// The stiffest degree of freedom of each moving body, the largest k/M first: what each alone would
/// ask for. Empty where K is not known.
std::vector<StiffnessLeader> stiffness_by_body(const Scene& scene, const State& state);

}  // namespace substep
