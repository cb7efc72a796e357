#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

struct Momenta {
  Vec3 linear = Vec3::Zero();   // world axes [kg m/s]
  Vec3 angular = Vec3::Zero();  // about the world's origin, world axes [kg m^2/s]
};

/// Momenta of all moving bodies, with velocities synchronised to the poses.
Momenta momenta_of(const Scene& scene, const State& state);

}  // namespace substep
