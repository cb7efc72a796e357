#pragma once

#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// The stiffest degree of freedom of a body that moves. K must be known.
StiffnessLeader stiffest_of(const Scene& scene, const State& state, std::size_t body);

/// The stiffest degree of freedom of each moving body, the largest k/M first: what each alone would
/// ask for. Empty where K is not known.
std::vector<StiffnessLeader> stiffness_by_body(const Scene& scene, const State& state);

/// What each body requires: its largest k/M over that of the whole scene, 0..1, 0 of what does not
/// move. Empty where K is not known or nothing is stiff.
std::vector<double> stiffness_shares(const Scene& scene, const State& state);

}  // namespace substep
