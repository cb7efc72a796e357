#pragma once

#include <array>
#include <string_view>

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

struct NamedEffect {
  std::string_view name;
  bool Effects::*member;
};

/// The names of effects in scene files, in file order.
inline constexpr std::array kEffectNames{
    NamedEffect{"gravity", &Effects::gravity},   NamedEffect{"gyroscopic", &Effects::gyroscopic},
    NamedEffect{"joints", &Effects::joints},     NamedEffect{"contact", &Effects::contact},
    NamedEffect{"friction", &Effects::friction}, NamedEffect{"restitution", &Effects::restitution},
    NamedEffect{"external", &Effects::external}};

/// True if bodies have potential energy, from gravity or constant forces.
inline bool has_potential(const Effects& effects) { return effects.gravity || effects.external; }

}  // namespace substep
