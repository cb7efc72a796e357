#pragma once

#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// The scene as a file of format version 1: what read_scene reads back to an equal scene. The same
/// scene gives the same bytes everywhere; arrays of numbers stand on one line.
std::string write_scene(const Scene& scene);

}  // namespace substep
