#pragma once

#include <cstddef>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

/// The moving bodies of a scene as trees: each hangs on its parent by one joint, or is free. What
/// remains are joints that close loops. Static bodies are the world.
struct KinematicTree {
  struct Node {
    int body = -1;
    int parent = kWorld;  // a moving body, or kWorld
    int joint = -1;       // to the parent; -1: the body is free
    int depth = 0;        // of nested bodies, 1 below the world
  };
  std::vector<Node> nodes;   // every subtree is consecutive, its root first
  std::vector<int> closing;  // joints that are in no tree, ascending

  /// The joints that a loop keeps are those that least can replace: slides and universal joints,
  /// then hinges with parts such as drives, hinges, ball joints, welds. Distances and ropes never
  /// carry a body.
  static KinematicTree of(const Scene& scene);
};

}  // namespace substep
