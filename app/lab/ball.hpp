#pragma once

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// A ball that the user throws into a scene.
struct Ball {
  static constexpr int kMost = 24;  // per scene; a new one replaces the oldest

  Vec3 position = Vec3::Zero();  // world [m]
  Vec3 velocity = Vec3::Zero();  // world [m/s]
  double radius = 0.3;           // [m]
  double mass = 20.0;            // [kg]
};

/// The scene with the ball added, or replacing an earlier one. In a scene without contact only
/// balls collide; its own bodies still pass through each other.
/// @param slot index of the ball's body, at most the number of bodies
Scene with_ball(const Scene& scene, const Ball& ball, std::size_t slot);

/// Converts a state of the scene to the scene with the ball in that slot.
State with_ball(State state, const Ball& ball, std::size_t slot);

}  // namespace substep
