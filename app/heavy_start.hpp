#pragma once

#include <memory>
#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// Whether a run should wait for a person to start it: one sub-step is taken beside it to see what
/// a frame costs.
/// @return why, a sentence for people; "" where a frame takes less than about half a second
std::string heavy_start(const std::shared_ptr<const Scene>& scene, const Settings& settings);

}  // namespace substep
