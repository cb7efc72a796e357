#pragma once

#include <optional>

#include "core/model/scene.hpp"

namespace substep {

/// A mean energy that rises.
struct EnergyRise {
  double time = 0.0;   // [s]
  double rise = 0.0;   // over the mean of the first second [J]
  double limit = 0.0;  // a tenth of the energy that the motion exchanged [J]
};

/// Runs a tree of hinges and ball joints with steps as MuJoCo takes them, JointTree, explicit in
/// gyroscopic and Coriolis forces: these gain energy with any step, the faster a model moves. The
/// rise at which it fails, or nothing: it holds, or is no such tree. @param step, seconds [s]
std::optional<EnergyRise> rise_by_velocity_forces(const Scene& scene, double step, double seconds);

}  // namespace substep
