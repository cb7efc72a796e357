#pragma once
// Scenes far past the paper's: what a recommended setting has to hold.

#include <string>
#include <vector>

#include "core/model/scene.hpp"

namespace substep::scenes {

/// One scene of the hard set. Its criteria say what counts as holding: no joint opens, nothing
/// gains energy that nobody put in, and what should stand stands.
struct HardCase {
  std::string family;  // "mass ratio", "ropes", ...
  Scene scene;
};

/// The hard set: mass ratios, ropes, stacks, angles, slack chains, loops, impacts, friction,
/// frames, places, inertias and starts. Always in the same order.
std::vector<HardCase> hard_set();

}  // namespace substep::scenes
