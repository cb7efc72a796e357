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

  friend bool operator==(const Effects&, const Effects&) = default;
};

}  // namespace substep
