#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/settings.hpp"

namespace substep {

/// What a run should come to. kDepends: rounding or the start's last digits decide, and `why` tells
/// what makes it so.
enum class Expected : std::uint8_t { kHolds, kFails, kDepends };

/// A rule of a scene's verdict table: what is expected of the runs that it selects. A later rule
/// overrides an earlier one; runs that no rule selects are not in the table.
struct Expectation {
  // What a run is selected by; empty selects all.
  std::optional<SolverKind> solver{};
  std::optional<Mode> mode{};
  std::optional<int>
      n{};  // sub-steps per frame of mode kConst, >= 1; also puts this n in the table
  std::optional<Integrator> integrator{};

  Expected verdict = Expected::kHolds;
  std::optional<double> before{};  // of kFails: no later than this, else the scene's duration [s]
  std::string why{};               // in one sentence

  friend bool operator==(const Expectation&, const Expectation&) = default;
};
using Expectations = std::vector<Expectation>;

}  // namespace substep
