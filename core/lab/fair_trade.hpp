#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/lab/experiment_run.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// A run of adaptive sub-stepping, and the smallest constant N that is as accurate.
struct TradeRow {
  double load = 1.0;                 // Experiment::load
  const Result* adaptive = nullptr;  // never null
  const Result* constant = nullptr;  // null if no N that ran is enough, or the adaptive run failed
  int too_few = 0;                   // the largest N below it that ran, 0 if none

  /// Mean sub-steps per frame of the adaptive run.
  [[nodiscard]] double n() const;
};

/// Compares the cost of adaptive sub-stepping with that of a constant N chosen in hindsight, for
/// each load alone and for all loads together. A constant N is as accurate if its run holds and its
/// error is at most 5 % larger.
struct FairTrade {
  ErrorAxis axis = ErrorAxis::kGap;  // the error compared: joint gap, else overlap, else energy
  std::vector<double> alphas;        // that ran under every load, ascending
  double alpha = 0.0;                // the one compared
  int most_n = 0;                    // the largest constant N that ran under every load
  std::vector<TradeRow> rows;        // by load, ascending
  std::optional<int> for_all;        // the smallest N that is as accurate under every load

  /// Mean sub-steps per frame of the adaptive runs, all loads counted equally.
  [[nodiscard]] double mean_n() const;
  /// Whether the adaptive runs hold under every load.
  [[nodiscard]] bool holds() const;
};

/// The trade in the runs of a sweep with the direct solver and Euler's method, at the alpha of the
/// map that is nearest to `alpha`.
/// @param results of a sweep of this scene; must outlive the rows
/// @param policy when N is decided; per sub-step ran under the scene's own load only
/// @return without rows if nothing can be compared
FairTrade fair_trade(const Scene& scene, std::span<const Result> results, Policy policy,
                     double alpha);

}  // namespace substep
