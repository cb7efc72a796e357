#pragma once
// What a run begins with: the scene's start, or the nearest one that its joints allow.

#include <memory>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/joint_starts.hpp"

namespace substep {

/// What was found at a scene's start, and done about it.
struct StartReport {
  StartErrors found;          // of the scene as it stands
  StartErrors left;           // of the state that the run begins with
  bool continued = false;     // the scene continues a saved run: its errors are not corrected
  bool projected = false;     // poses or velocities were changed
  bool failed = false;        // no near start agrees with the joints: kept as it stands
  bool too_large = false;     // and that is since finding one would take too much memory or work
  double energy_found = 0.0;  // kinetic and potential, of the scene as it stands [J]
  double energy_begun = 0.0;  // of the state that the run begins with [J]
};

struct Start {
  State state;
  StartReport report;
};

/// The state that a run of the scene begins with, by Scene::start. A start within tolerance
/// (joint_starts.hpp), and a scene that continues a saved run, is initial_state() bit for bit.
/// A scene in memory that is to be refused is kept: refusing is the reader's.
Start start_of_run(const Scene& scene);

/// The scene with the poses and velocities of start_of_run(), for what reads them in its bodies:
/// itself where nothing is projected.
std::shared_ptr<const Scene> with_start_of_run(std::shared_ptr<const Scene> scene);

}  // namespace substep
