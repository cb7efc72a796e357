#pragma once

#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// The scene as a file of the newest version; read_scene returns an equal scene. The bytes are the
/// same on every machine; arrays of numbers are on one line.
std::string write_scene(const Scene& scene);

}  // namespace substep
