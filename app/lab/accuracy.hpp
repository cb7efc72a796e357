#pragma once

#include <array>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "app/lab/effect_costs.hpp"
#include "core/io/stored_sweep.hpp"
#include "core/lab/alpha_search.hpp"
#include "core/lab/fair_trade.hpp"
#include "core/lab/hold_search.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/sweep.hpp"

namespace substep {

/// Contents of the panel.
enum class AccuracyPicture : unsigned char {
  kErrorAgainstCost,
  kFairTrade,
  kStabilityMap,
  kEffectCosts,
  kFindN
};

/// "What does accuracy cost?": a sweep of all methods over the running scene, computed in slices
/// between frames; the points of its picture so far; a cost breakdown of a frame; and a search for
/// the paper's alpha.
class Accuracy {
 public:
  using Point = RunPoint;

  /// Starts a sweep of the scene. Discards earlier results.
  void start(std::shared_ptr<const Scene> scene);
  /// Shows the sweep that is shipped with the scene, if any, without times.
  /// Keeps results of a computed sweep unless `asked`. @return whether it is shown
  bool show_shipped(const std::shared_ptr<const Scene>& scene, bool asked = false);
  /// Whether the results were shipped with the scene.
  [[nodiscard]] bool shipped() const { return shipped_.has_value(); }
  /// Assigns the results to a scene with the same motion under another name.
  void assign_to(std::shared_ptr<const Scene> scene) { scene_ = std::move(scene); }
  /// Stops before the next frame. Keeps the results so far.
  void cancel();
  /// Computing time per frame [s]: a few milliseconds, less during playback; if drawing is slow (a
  /// page without a GPU), a share of the drawing time.
  /// @param drawing time of the last frame without its slice [s]
  [[nodiscard]] static double slice(bool plays, double drawing);
  /// Continues the pending work. @param seconds budget in this frame
  void advance(double seconds);

  /// Whether advance() has work to do.
  [[nodiscard]] bool busy() const {
    return effects.running() || trying() || searching() || running();
  }
  /// Whether the sweep is unfinished; a search pauses it.
  [[nodiscard]] bool running() const {
    return sweep_.has_value() && !cancelled_ && !sweep_->done();
  }
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  [[nodiscard]] double progress() const;      ///< 0 to 1
  [[nodiscard]] double seconds_left() const;  ///< wall time at the current pace [s], < 0 if unknown
  /// The scene of the results, or null.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  [[nodiscard]] const std::vector<Result>& results() const;
  [[nodiscard]] std::size_t planned() const { return experiments().size(); }
  [[nodiscard]] const std::vector<Experiment>& experiments() const;
  /// Whether the sweep varies the heaviest mass; without different masses there is no map.
  [[nodiscard]] bool has_map() const;
  /// Null until it is computed.
  [[nodiscard]] const ReferenceSummary* reference() const;
  /// Adaptive sub-stepping at trade_alpha and trade_policy beside constant N.
  [[nodiscard]] const FairTrade& trade();
  /// Path errors below this are within the uncertainty of the reference [m].
  [[nodiscard]] double floor() const;

  /// Stable runs at load 1 with a positive error, on the current axes. Errors below the floor are
  /// raised to the floor.
  [[nodiscard]] std::vector<Point> points() const;
  /// The point that meets the requirement: the cheapest within the error, or the most accurate
  /// within the cost. Empty if there is none.
  [[nodiscard]] std::optional<Point> best(const std::vector<Point>& points) const;
  /// Searches for the alpha of the paper's method that meets the requirement, between the values of
  /// its curve and with at most its maximum N. Requires can_search().
  void search_alpha();
  /// Whether the reference is available frame by frame, i.e. a sweep was computed.
  [[nodiscard]] bool can_search() const { return sweep_ && sweep_->reference() != nullptr; }
  void cancel_search() { search_.reset(); }
  /// The search for the current requirement, or null. It is paused while another requirement is
  /// set.
  [[nodiscard]] const AlphaSearch* alpha_search() const;
  [[nodiscard]] bool searching() const { return alpha_search() && !search_->done(); }
  /// Maximum number of sub-steps in the search.
  [[nodiscard]] int search_cap() const { return paper_.n_max; }
  /// Whether the reference is certain enough for the limit of the error.
  [[nodiscard]] bool can_promise() const;
  /// Runs the settings within the error for the scene's whole duration, the cheapest first, until
  /// one meets it. Requires a limit on an error.
  void try_whole();
  void cancel_trial() { trial_.reset(); }
  /// The trial for the current requirement, or null.
  [[nodiscard]] const HoldSearch* trial() const;
  [[nodiscard]] bool trying() const { return trial() && !trial_->done(); }
  /// The recommendation that the trial has found, once.
  std::optional<Recommended> take_recommended();
  /// Failed runs at load 1.
  [[nodiscard]] std::vector<Point> failed() const;
  /// Whether two or more runs have such an error.
  [[nodiscard]] bool has(ErrorAxis axis) const;

  /// Cost breakdown of a frame; measured before a sweep continues.
  EffectCosts effects;

  AccuracyPicture picture = AccuracyPicture::kErrorAgainstCost;
  bool all_methods = false;  // show every curve in its colour, not only the headline ones
  CostAxis cost = CostAxis::kOperations;  // the work per sub-step depends on the method
  ErrorAxis error = ErrorAxis::kTrajectory;
  // Adaptive sub-stepping in the comparison with a constant N; start() and show_shipped() select
  // the scene's own.
  double trade_alpha = 0.1;
  Policy trade_policy = Policy::kFrame;
  /// True: the error is limited and the cost minimised. False: the reverse.
  bool error_is_given = true;
  /// Largest error allowed, per axis [m, J].
  std::array<double, static_cast<std::size_t>(ErrorAxis::kCount)> wanted{1e-3, 1.0, 1e-4, 1e-4};
  /// Largest cost of a frame allowed, per axis [-, -, ms].
  std::array<double, static_cast<std::size_t>(CostAxis::kCount)> budget{8.0, 1e5, 0.05};

 private:
  /// The requirement: a limit on an error or a cost.
  struct Limit {
    bool of_error = true;
    std::size_t axis = 0;
    double most = 0.0;
    friend bool operator==(const Limit&, const Limit&) = default;
  };
  [[nodiscard]] Limit limit() const;
  /// Discards the results; the next ones are of this scene.
  void begin(std::shared_ptr<const Scene> scene);
  /// Selects axes for which the results have values.
  void select_available_axes();

  std::shared_ptr<const Scene> scene_;
  std::optional<Sweep> sweep_;
  std::optional<StoredSweep> shipped_;      // used instead of sweep_
  std::shared_ptr<const Scene> looked_up_;  // last scene for which a shipped sweep was looked up
  std::vector<Experiment> shipped_plan_;
  FairTrade trade_;
  // The number of results, alpha and policy of trade_; empty: outdated.
  std::optional<std::tuple<std::size_t, double, Policy>> trade_is_of_;
  Settings paper_;                     // settings of the sweep's paper curve, without alpha
  std::optional<AlphaSearch> search_;  // uses the sweep's reference
  Limit searched_for_;
  std::optional<HoldSearch> trial_;
  Limit tried_for_;
  bool cancelled_ = false;
  double elapsed_ = 0.0;  // wall time of the sweep, including the time between slices [s]
  double last_ = -1.0;    // wall clock at the last slice [s]
};

}  // namespace substep
