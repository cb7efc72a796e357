#pragma once

#include <vector>

#include "core/lab/experiment.hpp"

namespace substep {

/// The runs from which settings are recommended: default_sweep() under the scene's own load.
/// @param seconds duration of each run [s]
/// @param defaults adds the default settings along alpha
/// @return each experiment once, in the order of default_sweep(); empty if the scene cannot run
std::vector<Experiment> all_methods(const Scene& scene, double seconds, bool defaults);

}  // namespace substep
