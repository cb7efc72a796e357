#pragma once

#include <cstdint>
#include <vector>

#include "core/math/types.hpp"
#include "core/model/carried.hpp"

namespace substep {

struct Scene;

/// All variables of a running scene. A copy is a snapshot, from which the motion continues bit for
/// bit.
struct State : Carried {
  std::vector<Vec3> x;  // centre of mass, world [m]
  std::vector<Quat> q;  // q_WB, unit [-]
  std::int64_t frame = 0;
  double time = 0.0;                 // [s]
  std::vector<Vec6> u_synchronised;  // u at the time of x, for energies
};

/// The initial state: the scene's bodies, and the carried state of an earlier run.
State initial_state(const Scene& scene);

/// Hash of the bits of time, poses and velocities.
std::uint64_t state_hash(const State& state);

}  // namespace substep
