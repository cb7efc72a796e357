#pragma once

#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// What a changed scene has in common with the scene before the change: per body and per joint its
/// index there, or -1 if it is new.
struct Kept {
  std::vector<int> bodies;
  std::vector<int> joints;
};

/// Bodies are kept if their names are, which must be unique in their scene; joints likewise, if
/// their type, bodies and anchors are the same.
Kept kept_by_name(const Scene& before, const Scene& changed);

/// Adds, removes or changes bodies and joints during a run: the changed scene, starting from a
/// state of the scene before, at the end of a frame.
///
/// - What is kept has the poses, velocities and forces of the run, so that warm starts and resting
///   contacts last. If the order of the kept bodies is the same, islands that the change does not
///   touch continue bit for bit with methods whose operations on an island do not depend on others:
///   core/README.md, "Bodies and joints that come and go".
/// - A kept body whose initial pose or velocity was changed continues from the new one.
/// - What is new starts as the changed scene says. Bodies of new and removed joints restart, as
/// after
///   an impact, for integrators that read earlier sub-steps. Sleeping bodies wake.
///
/// The new simulator's start() reports new joints that are open. At time 0 the changed scene is
/// returned as it is. A scene without bodies if is_runnable() or
/// fits() says no, or `kept` does not fit.
Scene continue_with(Scene changed, const Scene& before, const State& state, const Kept& kept);

}  // namespace substep
