#pragma once

#include <string>
#include <vector>

#include "core/lab/experiment_run.hpp"
#include "core/model/expectation.hpp"

namespace substep {

/// One run of a scene's verdict table.
struct VerdictCell {
  Settings settings;
  Expectation expected{};  // the rule that decides
};

/// The table of a scene: BPP and PGS x all modes (const with 4, 16 and what rules name) x Euler
/// and leapfrog, Newton and XPBD x one sub-step and const with Euler, as far as a rule speaks of
/// them; all else is the scene's own. A scene without rules has one cell: its own settings and
/// criteria.
std::vector<VerdictCell> verdict_table(const Scene& scene);

/// "bpp const 16 leapfrog"
std::string cell_name(const Settings& settings);

/// A run beside what was expected of it.
struct Judgement {
  bool as_expected = false;
  /// How far from the other answer: of a run that held, the share of the tightest criterion that
  /// was left; of one that failed, the share of the time that was left. [-], in [0, 1]
  double margin = 0.0;
};

/// @param run that is over
Judgement judge(const Scene& scene, const Expectation& expected, const ExperimentRun& run);

}  // namespace substep
