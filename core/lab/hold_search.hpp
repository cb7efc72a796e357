#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

/// Searches the first of several runs that also serves when it lasts longer: one that is accurate
/// for 2 s may fail at 5.5 s. Runs them from the start, in slices like a sweep.
class HoldSearch {
 public:
  static constexpr std::size_t kMost = 20;  // runs tried
  using Serves = std::function<bool(const Result&)>;

  /// @param candidates shorter runs that serve, the preferred first
  /// @param seconds duration of the runs that are tried [s]; a candidate of this duration is taken
  /// as it is
  /// @param reference of the scene; must outlive the search
  /// @param serves judges the complete run, if it holds; without it, each serves that holds
  /// @param budget of each frame
  HoldSearch(std::shared_ptr<const Scene> scene, std::vector<Result> candidates, double seconds,
             const Reference& reference, Serves serves, const Budget& budget = {});

  /// Continues for about this long, at least one frame of a run. @return false when done
  bool advance(double seconds);
  [[nodiscard]] bool done() const { return found_ || !run_; }
  [[nodiscard]] double progress() const;  ///< 0 to 1, of the current run
  /// The runs that do not serve, in the order of the candidates.
  [[nodiscard]] const std::vector<Result>& failed() const { return failed_; }
  /// When done: the index of the first candidate that serves, or nothing.
  [[nodiscard]] std::optional<std::size_t> found() const { return found_; }

 private:
  void start();
  void advance_by_a_frame();

  std::shared_ptr<const Scene> scene_;
  std::vector<Result> candidates_;
  double seconds_;  // [s]
  const Reference* reference_;
  Serves serves_;
  Budget budget_;
  std::unique_ptr<ExperimentRun> run_;  // of the candidate after the failed ones
  std::vector<Result> failed_;
  std::optional<std::size_t> found_;
};

}  // namespace substep
