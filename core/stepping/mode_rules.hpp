#pragma once

#include <cstdint>

#include "core/model/settings.hpp"

namespace substep {

/// How many sub-steps a frame takes.
enum class SubstepCount : std::uint8_t {
  kOne,
  kGiven,         // Settings::n
  kStable,        // N by Eq. 11, at most n_max
  kStableCapped,  // the same, at most n_cap
};

/// The mass Mt of rotations that are too stiff for a sub-step.
enum class StiffMass : std::uint8_t {
  kOwn,        // M
  kDamped,     // damping.hpp
  kFull,       // M - dt^2 K, what of it resists: full_stiffness.hpp
  kGeometric,  // geometric_inertia.hpp
};

/// The share beta of the velocity term that is taken with Mt; geometric_inertia.hpp.
enum class KeptVelocity : std::uint8_t {
  kNothing,
  kShare,  // Settings::beta
  kAll,
};

/// What a mode is made of.
struct ModeRules {
  SubstepCount count = SubstepCount::kOne;
  StiffMass mass = StiffMass::kOwn;
  KeptVelocity kept = KeptVelocity::kNothing;
};

/// The one place that knows: all of stepping and the sweep go by it.
constexpr ModeRules rules_of(Mode mode) {
  switch (mode) {
    case Mode::kNone:
      return {SubstepCount::kOne};
    case Mode::kConst:
      return {SubstepCount::kGiven};
    case Mode::kAdaptive:
      return {SubstepCount::kStable};
    case Mode::kDamping:
      return {SubstepCount::kOne, StiffMass::kDamped};
    case Mode::kCapped:
      return {SubstepCount::kStableCapped, StiffMass::kDamped};
    case Mode::kStiffness:
      return {SubstepCount::kOne, StiffMass::kFull};
    case Mode::kInertia:
      return {SubstepCount::kStableCapped, StiffMass::kGeometric, KeptVelocity::kAll};
    case Mode::kBlend:
      return {SubstepCount::kStableCapped, StiffMass::kGeometric, KeptVelocity::kShare};
    case Mode::kCount:
      break;
  }
  return {};
}

}  // namespace substep
