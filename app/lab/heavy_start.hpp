#pragma once

#include <memory>
#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// A run that waits for a person to start it, since its frames take long.
struct HeavyStart {
  std::string why;  // empty where there is none
  int run = 0;      // Lab::run_count then
};

/// Whether a run should wait for a person to start it: one sub-step is taken beside it to see what
/// a frame costs.
/// @return why, a sentence for people; "" where a frame takes less than about half a second
std::string heavy_start(const std::shared_ptr<const Scene>& scene, const Settings& settings);

}  // namespace substep
