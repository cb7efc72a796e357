#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

struct Energies {
  double kinetic = 0.0;    // [J]
  double potential = 0.0;  // of gravity and of constant forces, zero at the world's origin [J]
};

/// Of the moving bodies, from the velocities that belong to the time of the poses. A constant
/// torque has no potential: its work changes the sum.
Energies energies_of(const Scene& scene, const State& state);

/// No less than twice a body's kinetic energy, and finite only where its velocity is [J].
double most_kinetic(const Body& body, const Vec6& u);

}  // namespace substep
