#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/effect_costs.hpp"
#include "core/io/stored_sweep.hpp"
#include "core/lab/alpha_search.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/sweep.hpp"

namespace substep {

/// What the panel shows.
enum class AccuracyPicture : unsigned char { kErrorAgainstCost, kStabilityMap, kEffectCosts };

/// "What does accuracy cost?": a sweep of all methods over the running scene, in slices beside the
/// frames, and the points of its picture as they come; what the parts of a frame cost; and a search
/// for the paper's alpha.
class Accuracy {
 public:
  using Point = RunPoint;

  /// Sweeps this scene; what was there before is forgotten.
  void start(std::shared_ptr<const Scene> scene);
  /// Shows the sweep that is shipped with this scene, where there is one: at once, without times.
  /// Results of a sweep that ran are kept unless `asked`. @return whether it is shown
  bool show_shipped(const std::shared_ptr<const Scene>& scene, bool asked = false);
  /// Whether the results were shipped with the scene.
  [[nodiscard]] bool shipped() const { return shipped_.has_value(); }
  /// The results are of this scene, which moves as theirs does: it is the same by another name.
  void is_of(std::shared_ptr<const Scene> scene) { scene_ = std::move(scene); }
  /// Stops within the frame. The results so far stay.
  void cancel();
  /// What a frame can spare for it, less beside a run that plays: a few milliseconds, or, where
  /// drawing is slow (a page without a graphics processor), a share of what it takes. [s]
  /// @param drawing that the last frame took, without its slice [s]
  [[nodiscard]] static double slice(bool plays, double drawing);
  /// Goes on for about so long with what runs. @param seconds of this frame's time
  void advance(double seconds);

  /// Whether advance() has something to do.
  [[nodiscard]] bool busy() const { return effects.running() || searching() || running(); }
  /// Whether the sweep is unfinished; it waits while a search runs.
  [[nodiscard]] bool running() const {
    return sweep_.has_value() && !cancelled_ && !sweep_->done();
  }
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  [[nodiscard]] double progress() const;      ///< 0 to 1
  [[nodiscard]] double seconds_left() const;  ///< wall time at the present pace [s], < 0 unknown
  /// The scene of the results, or null.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  [[nodiscard]] const std::vector<Result>& results() const;
  [[nodiscard]] std::size_t planned() const { return experiments().size(); }
  [[nodiscard]] const std::vector<Experiment>& experiments() const;
  /// Whether the heaviest body's mass is varied: bodies of one mass have no map.
  [[nodiscard]] bool has_map() const;
  /// Null until it is found.
  [[nodiscard]] const ReferenceSummary* reference() const;
  /// Errors below this are not measured: the uncertainty of the reference, of paths [m].
  [[nodiscard]] double floor() const;

  /// Runs of the scene as it stands that hold, with a positive error, by the axes; where it is
  /// below the floor, at the floor.
  [[nodiscard]] std::vector<Point> points() const;
  /// What comes up to what is wanted: the cheapest within the error, or the most exact within the
  /// cost. Nothing does where it is empty.
  [[nodiscard]] std::optional<Point> best(const std::vector<Point>& points) const;
  /// Looks for the alpha of the paper's method that comes up to what is wanted, between the values
  /// of its curve and with as many sub-steps at most. Where can_search().
  void search_alpha();
  /// Whether the reference is there, frame by frame: after a sweep that ran.
  [[nodiscard]] bool can_search() const { return sweep_ && sweep_->reference() != nullptr; }
  void cancel_search() { search_.reset(); }
  /// The search for the present requirement, or null. It waits while another one is set.
  [[nodiscard]] const AlphaSearch* alpha_search() const;
  [[nodiscard]] bool searching() const { return alpha_search() && !search_->done(); }
  /// What its sub-steps are capped at.
  [[nodiscard]] int search_cap() const { return paper_.n_max; }
  /// Runs of the scene as it stands that failed.
  [[nodiscard]] std::vector<Point> failed() const;
  /// Whether two runs or more have such an error.
  [[nodiscard]] bool has(ErrorAxis axis) const;

  /// What the parts of a frame cost; measured before a sweep continues.
  EffectCosts effects;

  AccuracyPicture picture = AccuracyPicture::kErrorAgainstCost;
  bool all_methods = false;               // every curve in its colour, not only the headline ones
  CostAxis cost = CostAxis::kOperations;  // a sub-step is not the same work with every method
  ErrorAxis error = ErrorAxis::kTrajectory;
  /// Whether an error is given and the least cost is looked for, or the other way around.
  bool error_is_given = true;
  /// The largest error allowed, by its axis [m, J].
  std::array<double, static_cast<std::size_t>(ErrorAxis::kCount)> wanted{1e-3, 1.0, 1e-4, 1e-4};
  /// What a frame may cost at most, by its axis [-, -, ms].
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
  /// Where the runs have no error or no cost of the kind that is looked at, one that they have.
  void look_at_what_there_is();

  std::shared_ptr<const Scene> scene_;
  std::optional<Sweep> sweep_;
  std::optional<StoredSweep> shipped_;      // in its place
  std::shared_ptr<const Scene> looked_up_;  // last, for what is shipped with it
  std::vector<Experiment> shipped_plan_;
  Settings paper_;                     // of the sweep's curve, without its alpha
  std::optional<AlphaSearch> search_;  // goes by the reference of the sweep
  Limit searched_for_;
  bool cancelled_ = false;
  double elapsed_ = 0.0;  // wall time of the sweep, the time between the slices included [s]
  double last_ = -1.0;    // wall clock at the last slice [s]
};

}  // namespace substep
