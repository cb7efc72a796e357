#pragma once

#include <cstdint>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// What came of a projection.
enum class Projection : std::uint8_t {
  kDone,
  kFailed,   // no state near the start agrees with the joints
  kTooLarge  // it would take more memory or work than a start may
};

/// Moves bodies by the least change that closes the joints: poses q with phi(q) = 0 and
/// M (q - q0) = J(q)^T mu, which is the nearest to the start q0 in the norm of the masses. Bodies
/// that no joint ties to what is static keep their common centre of mass. Rows of springs
/// (joint_starts.hpp) stay free; contacts are not looked at.
/// The state is spoilt where it fails.
Projection close_joints(const Scene& scene, State& state);

/// Changes velocities by the least impulses after which they agree with the joints at the state's
/// poses: J u = 0 with u - u0 = M^-1 J^T impulse. What no joint ties to what is static keeps its
/// momentum.
/// The state is spoilt where it fails.
Projection match_velocities(const Scene& scene, State& state);

}  // namespace substep
