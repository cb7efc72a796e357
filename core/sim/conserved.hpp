#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

struct Energies {
  double kinetic = 0.0;    // [J]
  double potential = 0.0;  // gravity and constant forces, zero at the world origin [J]

  [[nodiscard]] double sum() const { return kinetic + potential; }
};

/// Energies of the moving bodies, with velocities synchronised to the poses. A constant torque has
/// no potential: its work changes the sum.
Energies energies_of(const Scene& scene, const State& state);

struct Momenta {
  Vec3 linear = Vec3::Zero();   // world axes [kg m/s]
  Vec3 angular = Vec3::Zero();  // about the world's origin, world axes [kg m^2/s]
};

/// Momenta of all moving bodies, with velocities synchronised to the poses.
Momenta momenta_of(const Scene& scene, const State& state);

}  // namespace substep
