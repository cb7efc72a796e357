#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/lab/verdict.hpp"
#include "core/model/budget.hpp"
#include "core/model/scene.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// A change of settings that may help a run that failed.
struct Remedy {
  std::string text;  // "a smaller alpha, 0.05"
  std::string why;   // the reason: "43 were required"; or ""
  Settings settings;
};

/// Suggestions, the most likely first: the implicit gyroscopic torque instead of the explicit one,
/// adaptive sub-steps if not used, a larger cap if it was reached, the direct solver instead of
/// Gauss-Seidel, the soft drift law for impacts on joints, a smaller alpha, the default settings.
/// For a gain of energy or an overlap the default settings come first, and a smaller alpha is none.
/// None has been tried. @param last the report of the failed frame @param exceeded
/// Verdict::exceeded()
/// @return empty if no setting would help
std::vector<Remedy> remedies(const Settings& settings, const FrameReport& last,
                             const std::optional<Exceeded>& exceeded);

/// How remedies are tried.
struct Trial {
  std::int64_t frames = 0;  // of the run that failed: as many must hold
  Budget budget = {};
  std::size_t enough = 2;  // remedies that hold
  double most_work = 3e6;  // of one remedy [sub-steps times bodies]; one that needs more is left
  std::function<bool()> cancelled = [] { return false; };
};

struct TriedRemedies {
  std::vector<Remedy> hold;  // for the whole run
  int failed = 0;            // that do not hold; those that need too much work are not counted
};

/// Runs the scene from its start with each remedy.
TriedRemedies try_remedies(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                           const FrameReport& failed, const std::optional<Exceeded>& exceeded,
                           const Trial& trial);

}  // namespace substep
