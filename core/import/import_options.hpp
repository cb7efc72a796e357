#pragma once

#include <string>

namespace substep {

struct ImportOptions {
  std::string key;         // MJCF: the keyframe to start in, by name or number; "": none
  bool collide = false;    // spheres, boxes and planes collide
  bool free_root = false;  // URDF: the root link is not fixed to the world
};

}  // namespace substep
