#pragma once

namespace substep {

/// The effects that a scene uses. A disabled effect has no stage, memory, rows or run time.
struct Effects {
  bool gravity = false;
  bool gyroscopic = false;
  bool joints = false;
  bool contact = false;
  bool friction = false;
  bool restitution = false;
  bool external = false;  // the constant forces and torques of bodies

  friend bool operator==(const Effects&, const Effects&) = default;
};

/// True if bodies have potential energy, from gravity or constant forces.
inline bool has_potential(const Effects& effects) { return effects.gravity || effects.external; }

}  // namespace substep
