#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Moves bodies by the least change that closes the joints: poses q with phi(q) = 0 and
/// M (q - q0) = J(q)^T mu, which is the nearest to the start q0 in the norm of the masses. Bodies
/// that no joint ties to what is static keep their common centre of mass. Rows of springs
/// (joint_starts.hpp) stay free; contacts are not looked at.
/// @return false where no poses near the start close the joints; the state is spoilt then
bool close_joints(const Scene& scene, State& state);

/// Changes velocities by the least impulses after which they agree with the joints at the state's
/// poses: J u = 0 with u - u0 = M^-1 J^T impulse. What no joint ties to what is static keeps its
/// momentum.
/// @return false where velocities do not agree then; the state is spoilt
bool match_velocities(const Scene& scene, State& state);

}  // namespace substep
