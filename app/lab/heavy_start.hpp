#pragma once

#include <memory>
#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// What is needed to start a run again.
struct RunStart {
  std::shared_ptr<const Scene> scene;
  Settings settings;
  double load = 1.0;  // of Experiment [-]
  int seed = 0;
  bool playing = false;
};

/// A run that came from outside and has not started: what its frames cost is not forecast yet.
struct OpenedRun {
  int run = 0;         // Lab::run_count then
  bool plays = false;  // unless its frames take long
  RunStart before;     // the run that it replaced
};

/// A run that waits for a person to start it, since its frames take long.
struct HeavyStart {
  std::string why;  // empty where there is none
  int run = 0;      // Lab::run_count then
  RunStart before;  // the run that it replaced
};

/// Whether a run should wait for a person to start it: one sub-step is taken beside it to see what
/// a frame costs.
/// @return why, a sentence for people; "" where a frame takes less than about half a second
std::string heavy_start(const std::shared_ptr<const Scene>& scene, const Settings& settings);

}  // namespace substep
