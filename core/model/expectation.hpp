#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/settings.hpp"

namespace substep {

/// Expected outcome of a run. kDepends: decided by rounding or the last digits of the initial
/// state; `why` holds the reason.
enum class Expected : std::uint8_t { kHolds, kFails, kDepends };

/// A rule of a scene's verdict table: the expected outcome of the runs it selects. Later rules
/// override earlier ones; runs that no rule selects are not in the table.
struct Expectation {
  // Selection of runs; empty selects all.
  std::optional<SolverKind> solver{};
  std::optional<Mode> mode{};
  std::optional<int>
      n{};  // sub-steps per frame of mode kConst, >= 1; also puts this n in the table
  std::optional<Integrator> integrator{};

  Expected verdict = Expected::kHolds;
  std::optional<double> before{};  // kFails: latest failure time, else the duration [s]
  std::string why{};               // in one sentence

  friend bool operator==(const Expectation&, const Expectation&) = default;
};
using Expectations = std::vector<Expectation>;

}  // namespace substep
