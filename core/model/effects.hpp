#pragma once

namespace substep {

/// What a scene calls for. An effect that is false has no stage, no memory, no rows and no time.
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

/// Whether bodies have a potential energy: that of gravity, and of constant forces.
inline bool has_potential(const Effects& effects) { return effects.gravity || effects.external; }

}  // namespace substep
