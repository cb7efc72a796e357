#pragma once

#include <cstdint>

#include "core/model/settings.hpp"

namespace substep {

/// How many sub-steps a frame takes.
enum class Count : std::uint8_t {
  kOne,
  kGiven,         // Settings::n
  kStable,        // N by Eq. 11, at most n_max
  kStableCapped,  // the same, at most n_cap
};

/// The mass Mt of rotations that are too stiff for a sub-step.
enum class StiffMass : std::uint8_t {
  kOwn,        // M
  kDamped,     // damping.hpp
  kFull,       // M - dt^2 K, what of it resists: math/resisting.hpp
  kGeometric,  // geometric_inertia.hpp
};

/// The share beta of the velocity term that is taken with Mt; geometric_inertia.hpp.
enum class Kept : std::uint8_t {
  kNothing,
  kShare,  // Settings::beta
  kAll,
};

/// What a mode is made of.
struct ModeRules {
  Count count = Count::kOne;
  StiffMass mass = StiffMass::kOwn;
  Kept kept = Kept::kNothing;
};

/// The one place that knows: all of stepping and the sweep go by it.
constexpr ModeRules rules_of(Mode mode) {
  switch (mode) {
    case Mode::kNone:
      return {Count::kOne};
    case Mode::kConst:
      return {Count::kGiven};
    case Mode::kAdaptive:
      return {Count::kStable};
    case Mode::kDamping:
      return {Count::kOne, StiffMass::kDamped};
    case Mode::kCapped:
      return {Count::kStableCapped, StiffMass::kDamped};
    case Mode::kStiffness:
      return {Count::kOne, StiffMass::kFull};
    case Mode::kInertia:
      return {Count::kStableCapped, StiffMass::kGeometric, Kept::kAll};
    case Mode::kBlend:
      return {Count::kStableCapped, StiffMass::kGeometric, Kept::kShare};
  }
  return {};
}

}  // namespace substep
