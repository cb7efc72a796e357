#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/lab/experiment_run.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// A run of adaptive sub-stepping, and the smallest constant N that is no less exact.
struct TradeRow {
  double load = 1.0;                 // Experiment::load
  const Result* adaptive = nullptr;  // never null
  const Result* constant = nullptr;  // null if no N that ran is enough, or the adaptive run failed
  int too_few = 0;                   // the largest N below it that ran, 0 if none

  /// Mean sub-steps per frame of the adaptive run.
  [[nodiscard]] double n() const;
};

/// What it is worth not to choose N: adaptive sub-stepping at one alpha beside constant numbers of
/// sub-steps that are chosen in hindsight, for each load alone and for all loads together. A
/// constant N is no less exact if its run holds and its error is at most 5 % larger.
struct FairTrade {
  ErrorAxis axis = ErrorAxis::kGap;  // the error compared
  double alpha = 0.0;
  int most_n = 0;              // the largest constant N that ran under every load
  std::vector<TradeRow> rows;  // by load, ascending
  std::optional<int> for_all;  // the smallest N that is no less exact under every load

  /// Mean sub-steps per frame of the adaptive runs, all loads counted equally.
  [[nodiscard]] double mean_n() const;
  /// Whether the adaptive runs hold under every load.
  [[nodiscard]] bool holds() const;
};

/// The alphas of the map that ran under every load of this policy, ascending.
/// @param results of a sweep of this scene
std::vector<double> trade_alphas(const Scene& scene, std::span<const Result> results,
                                 Policy policy);

/// Compares the runs of a sweep with the direct solver and Euler's method.
/// @param policy when N is decided; per sub-step ran under the scene's own load only
/// @param alpha one of trade_alphas()  @param results must outlive the rows
/// @return without rows if nothing can be compared
FairTrade fair_trade(const Scene& scene, std::span<const Result> results, Policy policy,
                     double alpha);

}  // namespace substep
