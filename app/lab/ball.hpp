#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// What a person throws into a scene.
struct Ball {
  static constexpr int kMost = 24;  // in one scene: the oldest goes

  Vec3 position = Vec3::Zero();  // world [m]
  Vec3 velocity = Vec3::Zero();  // world [m/s]
  double radius = 0.3;           // [m]
  double mass = 20.0;            // [kg]
};

/// The scene with one more body, or with another one in the place of an earlier ball. A scene
/// without contact gets it, for balls alone: its own bodies still pass through each other.
/// @param slot index of the ball's body, at most the number of bodies that there are
Scene with_ball(const Scene& scene, const Ball& ball, std::size_t slot);

/// The state of a scene, carried over to the scene that has the ball in that slot.
State with_ball(State state, const Ball& ball, std::size_t slot);

}  // namespace substep
