#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

struct Energies {
  double kinetic = 0.0;    // [J]
  double potential = 0.0;  // gravity and constant forces, zero at the world origin [J]
};

/// Energies of the moving bodies, with velocities synchronised to the poses. A constant torque has
/// no potential: its work changes the sum.
Energies energies_of(const Scene& scene, const State& state);

}  // namespace substep
