#pragma once

#include <span>

#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {

/// u += time M^-1 (force, torque) for the constant forces and torques of moving bodies.
/// @param own M^-1 about principal axes, per body  @param time duration of the forces, per body [s]
/// @param u per body [m/s, rad/s], world
void add_external(const Scene& scene, const Part& part, std::span<const InertiaInverse> own,
                  std::span<const Mat3> R_WB, std::span<const double> time, std::span<Vec6> u);

}  // namespace substep
