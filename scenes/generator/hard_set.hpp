#pragma once
// Scenes far more difficult than the paper's; a robust setting must hold them.

#include <string>
#include <vector>

#include "core/model/scene.hpp"

namespace substep::scenes {

/// One scene of the hard set. Its criteria define when it holds: no joint opens, the energy does
/// not grow, and stacks stand.
struct HardCase {
  std::string family;  // "mass ratio", "ropes", ...
  Scene scene;
};

/// The hard set: mass ratios, ropes, stacks, angles, slack chains, loops, impacts, friction, frame
/// durations, positions, moments of inertia and initial states. Always in the same order.
std::vector<HardCase> hard_set();

}  // namespace substep::scenes
