#pragma once
// The initial state of a run: the scene's own, or the nearest one consistent with its joints.

#include <memory>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/joint_starts.hpp"

namespace substep {

/// Errors of a scene's initial state, and their treatment.
struct StartReport {
  StartErrors found;          // in the initial state of the scene
  StartErrors left;           // in the initial state of the run
  bool continued = false;     // the scene continues a saved run: its errors are not corrected
  bool projected = false;     // poses or velocities were changed
  bool failed = false;        // no consistent state was found nearby: left unchanged
  bool too_large = false;     // failed because the projection would need too much memory or work
  double energy_found = 0.0;  // kinetic and potential, of the scene's own initial state [J]
  double energy_begun = 0.0;  // of the initial state of the run [J]
};

struct Start {
  State state;
  StartReport report;
};

/// The initial state of a run of the scene, by Scene::start. If the errors are within tolerance
/// (joint_starts.hpp), or the scene continues a saved run, it equals initial_state() bit for bit.
/// StartPolicy::kRefuse acts as kKeep here: only the scene reader refuses.
Start start_of_run(const Scene& scene);

/// The scene with its bodies at the poses and velocities of start_of_run(); the same scene if
/// nothing is projected.
std::shared_ptr<const Scene> with_start_of_run(std::shared_ptr<const Scene> scene);

}  // namespace substep
