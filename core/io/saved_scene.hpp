#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// A run as a scene of its own, to be written to a file: it starts where the run is now, with poses
/// and velocities of `state`, and with the run's settings. Forces and stiffness of the last
/// sub-step are in no scene file: the run goes on like any start, an adaptive one with the N of its
/// probe; with the same N it stays within micrometres of the original. Once time has passed, name
/// and title tell it ("bridge_at_3500ms"). The verdict table is of the scene as it was, and left
/// out.
Scene saved_scene(const Scene& scene, const State& state, const Settings& settings);

}  // namespace substep
