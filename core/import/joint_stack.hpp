#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/import/mechanism.hpp"
#include "core/model/scene_builder.hpp"

namespace substep {

/// A joint of a link as it stands at the start of the scene.
struct PlacedJoint {
  const LinkJoint* joint;
  Vec3 anchor;  // world [m]
  Vec3 axis;    // world, unit [-]
};

/// The two bodies that a stack of joints connects.
struct StackBodies {
  int a = 0;          // index of the body that moves
  int b = kWorld;     // index, or kWorld
  double size = 1.0;  // radius of gyration of a [m]
};

/// Adds what several joints in one place are together, without bodies between them. It is exact,
/// but the coordinates of the single joints are lost:
///   two hinges with crossing axes    a ball joint, and a rod that keeps the angle of the two axes
///   two hinges with skew axes        four rods between two points of each axis
///   three hinges through one point   a ball joint
///   the same or a ball, three slides nothing: the body is free
/// @param joints at least two, from the parent outwards
/// @return what they are, "a universal joint"; empty if there is no such constraint
std::string add_stack(SceneBuilder& builder, const StackBodies& bodies,
                      std::span<const PlacedJoint> joints);

}  // namespace substep
