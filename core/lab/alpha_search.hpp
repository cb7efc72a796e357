#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/lab/axes.hpp"

namespace substep {

/// An alpha (Eq. 5) that was chosen by what came of it.
struct AlphaChoice {
  double alpha = 0.0;  // [-]
  Result result;       // of the whole run with it
};

/// A search for an alpha over whole runs, in slices as a sweep is. It goes from 1 down by quarters,
/// since small alphas are dear to try, then halves the interval until its ends are within 2 %, and
/// takes for granted that a smaller alpha costs more and errs less. All that it tries has three
/// digits, so that people can type it. What it chooses was run: it holds, and keeps what it is
/// chosen for.
class AlphaSearch {
 public:
  static constexpr double kLeast = 1e-4;  // that is tried [-]

  /// For the largest alpha whose run holds with an error of no more than this.
  /// @param experiment whose other settings stand; its mode reads alpha
  /// @param reference of the scene; outlives the search
  /// @param budget of each frame
  static AlphaSearch largest_within(std::shared_ptr<const Scene> scene,
                                    const Experiment& experiment, const Reference& reference,
                                    ErrorAxis axis, double error, const Budget& budget = {});

  /// For the smallest alpha whose frames cost no more than this; nothing where that one fails.
  static AlphaSearch smallest_within(std::shared_ptr<const Scene> scene,
                                     const Experiment& experiment, const Reference& reference,
                                     CostAxis axis, double cost, const Budget& budget = {});

  /// Goes on for about that long, by a frame of a run at least. @return false when done
  bool advance(double seconds);
  [[nodiscard]] bool done() const { return phase_ == Phase::kDone; }
  /// 0 to 1; leaps where fewer runs do than might have been.
  [[nodiscard]] double progress() const;
  [[nodiscard]] double alpha() const { return alpha_; }  ///< that is being tried
  [[nodiscard]] int runs() const { return runs_; }       ///< the present one included
  /// The best so far; when done, nothing where no alpha from kLeast to 1 serves.
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
  bool until_it_serves_;  // what ends the way down: the first that serves, or that does not
  Budget budget_;

  Phase phase_ = Phase::kDown;
  int quarters_;  // runs of the way down, at most while it lasts
  double alpha_ = 1.0;
  int runs_ = 0;
  std::unique_ptr<ExperimentRun> run_;
  std::optional<AlphaChoice> good_;
  double bad_ = 0.0;  // an alpha that does not serve, beside good_; 0 where none is known
};

}  // namespace substep
