#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/lab/run_events.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The data needed to restart a run.
struct RunStart {
  std::shared_ptr<const Scene> scene;
  Settings settings;
  double load = 1.0;  // of Experiment [-]
  int seed = 0;
  double pause_at = 0.0;         // end of an experiment, 0 if none [s]
  std::vector<RunEvent> events;  // user actions, followed as a script
  bool playing = false;
};

/// An opened run that has not started; the cost of its frames is not yet estimated.
struct OpenedRun {
  int run = 0;         // Lab::run_count at that time
  bool plays = false;  // unless its frames are slow
  RunStart before;     // the run that it replaced
};

/// A run that waits for confirmation because its frames are slow.
struct HeavyStart {
  std::string why;  // empty if there is none
  int run = 0;      // Lab::run_count at that time
  RunStart before;  // the run that it replaced
};

/// Whether a run should wait for confirmation. Takes one sub-step on a copy to estimate the cost of
/// a frame.
/// @return the reason, a sentence; "" if a frame takes less than about half a second
std::string heavy_start(const std::shared_ptr<const Scene>& scene, const Settings& settings);

}  // namespace substep
