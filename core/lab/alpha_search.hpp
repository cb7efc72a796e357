#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/lab/axes.hpp"

namespace substep {

/// A chosen alpha (Eq. 5) and the result of its run.
struct AlphaChoice {
  double alpha = 0.0;  // [-]
  Result result;       // of the whole run with it
};

/// Searches for an alpha by complete runs, in slices like a sweep. Starts at 1 and divides by 4,
/// since small alphas are expensive, then bisects until the interval is within 2 %. Assumes that a
/// smaller alpha costs more and has a smaller error. Candidates have three digits. The chosen alpha
/// was run, holds, and satisfies the criterion.
class AlphaSearch {
 public:
  static constexpr double kLeast = 1e-4;  // smallest candidate [-]

  /// For the largest alpha whose run holds with an error of no more than this.
  /// @param experiment provides all other settings; its mode reads alpha
  /// @param reference of the scene; must outlive the search
  /// @param budget of each frame
  static AlphaSearch largest_within(std::shared_ptr<const Scene> scene,
                                    const Experiment& experiment, const Reference& reference,
                                    ErrorAxis axis, double error, const Budget& budget = {});

  /// For the smallest alpha whose frames cost no more than this; no result if that run fails.
  static AlphaSearch smallest_within(std::shared_ptr<const Scene> scene,
                                     const Experiment& experiment, const Reference& reference,
                                     CostAxis axis, double cost, const Budget& budget = {});

  /// Continues for about this long, at least one frame of a run. @return false when done
  bool advance(double seconds);
  [[nodiscard]] bool done() const { return phase_ == Phase::kDone; }
  /// 0 to 1; may jump if fewer runs are needed than estimated.
  [[nodiscard]] double progress() const;
  [[nodiscard]] double alpha() const { return alpha_; }  ///< current candidate
  [[nodiscard]] int runs() const { return runs_; }       ///< including the current one
  /// The best so far; when done, nothing if no alpha from kLeast to 1 satisfies the criterion.
  [[nodiscard]] const std::optional<AlphaChoice>& choice() const { return good_; }

 private:
  enum class Phase : unsigned char { kDown, kHalving, kDone };
  using Serves = std::function<bool(const Result&)>;

  AlphaSearch(std::shared_ptr<const Scene> scene, const Experiment& experiment,
              const Reference& reference, Serves serves, bool until_it_serves,
              const Budget& budget);
  void start();
  void advance_by_a_frame();
  void take(const Result& result);

  std::shared_ptr<const Scene> scene_;
  Experiment experiment_;
  const Reference* reference_;
  Serves serves_;
  bool until_it_serves_;  // stop descending at the first success (true) or failure (false)
  Budget budget_;

  Phase phase_ = Phase::kDown;
  int quarters_;  // number of runs of the descent; an upper bound during it
  double alpha_ = 1.0;
  int runs_ = 0;
  std::unique_ptr<ExperimentRun> run_;
  std::optional<AlphaChoice> good_;
  double bad_ = 0.0;  // failing bound of the interval with good_; 0 if unknown
};

}  // namespace substep
