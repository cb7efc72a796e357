#pragma once

#include <string>
#include <vector>

#include "core/lab/experiment_run.hpp"
#include "core/model/expectation.hpp"

namespace substep {

/// One run of a scene's verdict table.
struct VerdictCell {
  Settings settings;
  Expectation expected{};  // the deciding rule
};

/// The table of a scene: BPP and PGS x all modes (const with 4, 16 and what rules name) x Euler
/// and leapfrog, Newton and XPBD x one sub-step and const with Euler, if selected by a rule; all
/// other settings are the scene's. A scene without rules has one cell: its own settings and
/// criteria.
std::vector<VerdictCell> verdict_table(const Scene& scene);

/// "bpp const 16 leapfrog"
std::string cell_name(const Settings& settings);

/// A run and its expected outcome.
struct Judgement {
  bool as_expected = false;
  /// Margin to the opposite outcome [-], in [0, 1]: for a run that held, the unused share of the
  /// tightest criterion; for a failed one, the remaining share of the time.
  double margin = 0.0;
};

/// @param run a completed run
Judgement judge(const Scene& scene, const Expectation& expected, const ExperimentRun& run);

}  // namespace substep
