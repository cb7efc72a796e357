#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace substep {

struct Scene;

/// The effects that a scene uses. A disabled effect has no stage, memory, rows or run time.
struct Effects {
  bool gravity = false;
  bool gyroscopic = false;
  bool joints = false;
  bool contact = false;
  bool friction = false;
  bool restitution = false;
  bool external = false;        // the constant forces and torques of bodies
  bool limits = false;          // of joints
  bool motors = false;          // of joints
  bool drives = false;          // of joints
  bool joint_friction = false;  // dry
  bool armature = false;        // of joints
  bool springs = false;         // of the coordinates of joints

  friend bool operator==(const Effects&, const Effects&) = default;
};

// Whether the content of a scene calls for an effect.
bool needs_gravity(const Scene& scene);
bool needs_gyroscopic(const Scene& scene);
bool needs_joints(const Scene& scene);
bool needs_contact(const Scene& scene);
bool needs_friction(const Scene& scene);
bool needs_restitution(const Scene& scene);
bool needs_external(const Scene& scene);
bool needs_limits(const Scene& scene);
bool needs_motors(const Scene& scene);
bool needs_drives(const Scene& scene);
bool needs_joint_friction(const Scene& scene);
bool needs_armature(const Scene& scene);
bool needs_springs(const Scene& scene);

struct EffectEntry {
  std::string_view name;  // in files
  bool Effects::*member;
  bool (*needed)(const Scene&);
  const char* about;                    // in a few words
  bool Effects::*depends_on = nullptr;  // another effect; null: none
  bool Effects::*or_on = nullptr;       // that one suffices too
};

/// Every effect, in file order: the one table for files, measured costs, window and command line.
inline constexpr std::array kEffects{
    EffectEntry{"gravity", &Effects::gravity, needs_gravity, "Weight: m g on every moving body."},
    EffectEntry{"gyroscopic", &Effects::gyroscopic, needs_gyroscopic,
                "The torque I ω × ω of bodies with unequal moments."},
    EffectEntry{"joints", &Effects::joints, needs_joints,
                "All joints. Off: bodies are not connected."},
    EffectEntry{"contact", &Effects::contact, needs_contact,
                "Contacts. Off: bodies pass through each other."},
    EffectEntry{"friction", &Effects::friction, needs_friction,
                "Coulomb friction in contacts, boxed: |λ t| ≤ μ λ n.", &Effects::contact},
    EffectEntry{"restitution", &Effects::restitution, needs_restitution,
                "Contacts and limits that bounce (Newton's law).", &Effects::contact,
                &Effects::limits},
    EffectEntry{"external", &Effects::external, needs_external,
                "Constant forces and torques of the scene on its bodies."},
    EffectEntry{"limits", &Effects::limits, needs_limits,
                "Limits of joints. Off: hinges turn and slides move freely.", &Effects::joints},
    EffectEntry{"motors", &Effects::motors, needs_motors, "Motors of joints.", &Effects::joints},
    EffectEntry{"drives", &Effects::drives, needs_drives, "Drives of joints towards a target.",
                &Effects::joints},
    EffectEntry{"joint_friction", &Effects::joint_friction, needs_joint_friction,
                "Dry friction of hinges and slides.", &Effects::joints},
    EffectEntry{"armature", &Effects::armature, needs_armature,
                "Inertia of the coordinates of hinges and slides: geared rotors.",
                &Effects::joints},
    EffectEntry{"springs", &Effects::springs, needs_springs,
                "Springs and dampers of hinges and slides.", &Effects::joints}};

constexpr bool lists_each_flag() {
  Effects listed;
  for (const EffectEntry& effect : kEffects) {
    if (std::exchange(listed.*effect.member, true)) return false;
  }
  return kEffects.size() == sizeof(Effects);
}
static_assert(lists_each_flag(), "one entry for each flag");

/// True if parts of joints act on their angle or travel.
inline bool acts_on_coordinates(const Effects& effects) {
  return effects.limits || effects.motors || effects.drives || effects.joint_friction ||
         effects.armature || effects.springs;
}

/// True if an effect can act: it depends on none, or on one that is enabled.
inline bool can_act(const EffectEntry& effect, const Effects& enabled) {
  return effect.depends_on == nullptr || enabled.*effect.depends_on ||
         (effect.or_on != nullptr && enabled.*effect.or_on);
}

/// Disables the effects that depend on a disabled one.
inline void disable_dependents(Effects& effects) {
  for (int pass = 0; pass < 2; ++pass) {  // restitution may depend on limits, they on joints
    for (const EffectEntry& effect : kEffects) {
      if (!can_act(effect, effects)) effects.*effect.member = false;
    }
  }
}

/// The effects that the content of a scene calls for.
Effects effects_of(const Scene& scene);

}  // namespace substep
