#pragma once

#include <cstdint>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Result of a projection.
enum class Projection : std::uint8_t {
  kDone,
  kFailed,   // no state near the start is consistent with the joints
  kTooLarge  // it would exceed the memory or work limits of a start
};

/// Closes the joints by the smallest change of the poses: phi(q) = 0 and M (q - q0) = J(q)^T mu,
/// the nearest q to the start q0 in the mass norm. Bodies not joined to a static body keep their
/// common centre of mass. Spring rows (joint_starts.hpp) and contacts are ignored. On failure the
/// state is invalid.
Projection close_joints(const Scene& scene, State& state);

/// Makes the velocities consistent with the joints by the smallest impulses at the state's poses:
/// J u = 0 with u - u0 = M^-1 J^T impulse. Bodies not joined to a static body keep their momentum.
/// On failure the state is invalid.
Projection match_velocities(const Scene& scene, State& state);

}  // namespace substep
