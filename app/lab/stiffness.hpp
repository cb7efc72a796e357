#pragma once

#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// The stiffest degree of freedom of a body that moves. K must be known.
StiffnessLeader stiffest_of(const Scene& scene, const State& state, std::size_t body);

/// The stiffest degree of freedom of each moving body, by descending k/M. Empty if K is not known.
std::vector<StiffnessLeader> stiffness_by_body(const Scene& scene, const State& state);

/// Each body's largest k/M relative to that of the scene, 0..1; 0 for static bodies. Empty if K is
/// not known or nothing is stiff.
std::vector<double> stiffness_shares(const Scene& scene, const State& state);

}  // namespace substep
