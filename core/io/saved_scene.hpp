#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// A run as a scene of its own, to be written to a file: it starts where the run is now, with poses
/// and velocities of `state`, with what its last sub-step left to the next one, and with the run's
/// settings. Between two frames it continues as the run would have, bit for bit. (Within a frame
/// the sub-steps to its end are chosen again; a hand that pulls lets go.) Once time has passed,
/// name and title say so ("bridge_at_3500ms"). The verdict table is of the scene as it was, and
/// left out.
Scene saved_scene(const Scene& scene, const State& state, const Settings& settings);

}  // namespace substep
