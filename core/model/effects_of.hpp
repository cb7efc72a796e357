#pragma once

#include "core/model/scene.hpp"

namespace substep {

/// The effects that the content of a scene requires, for files that do not list them.
Effects effects_of(const Scene& scene);

}  // namespace substep
