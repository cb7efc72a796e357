#pragma once

#include <string>

#include "core/io/json.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The scene as a file of the newest version; read_scene returns an equal scene. The bytes are the
/// same on every machine; arrays of numbers are on one line. Empty if a file cannot hold the scene:
/// a reference to a body that is not there, or a number that is not finite. Other invalid scenes
/// are written, and refused by read_scene with the same problems.
std::string write_scene(const Scene& scene);

/// One entry of "bodies", as write_scene() has it.
Json body_json(const Body& body);

/// One entry of "joints". @param scene with the joint's bodies
Json joint_json(const Scene& scene, const Joint& joint);

}  // namespace substep
