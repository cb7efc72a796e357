#pragma once

#include <cstdint>
#include <optional>

#include "core/model/settings.hpp"

namespace substep {

/// Number of sub-steps per frame.
enum class SubstepCount : std::uint8_t {
  kOne,
  kGiven,         // Settings::n
  kStable,        // N by Eq. 11, up to n_max
  kStableCapped,  // N by Eq. 11, up to n_cap
};

/// The mass Mt of rotations that are too stiff for a sub-step.
enum class StiffMass : std::uint8_t {
  kOwn,        // M
  kDamped,     // damping.hpp
  kFull,       // M - dt^2 K with the resisting part of K: full_stiffness.hpp
  kGeometric,  // geometric_inertia.hpp
};

/// Components of a mode.
struct ModeRules {
  SubstepCount count = SubstepCount::kOne;
  StiffMass mass = StiffMass::kOwn;
  // The share of the velocity term taken with Mt, geometric_inertia.hpp; none: Settings::beta.
  std::optional<double> beta = 0.0;
};

/// The single definition of the modes, used by stepping and the sweep.
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
      return {SubstepCount::kStableCapped, StiffMass::kGeometric, 1.0};
    case Mode::kBlend:
      return {SubstepCount::kStableCapped, StiffMass::kGeometric, std::nullopt};
    case Mode::kCount:
      break;
  }
  return {};
}

}  // namespace substep
