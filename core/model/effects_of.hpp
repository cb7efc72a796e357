#pragma once

#include "core/model/scene.hpp"

namespace substep {

/// What the content of a scene calls for, where its file does not list its effects.
Effects effects_of(const Scene& scene);

}  // namespace substep
