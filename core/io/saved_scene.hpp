#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// A run as a scene, to be written to a file: it starts from `state`, with its poses, velocities
/// and carried data, and with the run's settings. Saved between frames, it continues the run bit
/// for bit. (Within a frame the remaining sub-steps are rescheduled; a grab is released.) If time >
/// 0, it is part of name and title ("bridge_at_3500ms"). The verdict table of the original scene is
/// omitted. A scene without bodies if is_runnable() or fits() says no.
Scene saved_scene(const Scene& scene, const State& state, const Settings& settings);

}  // namespace substep
