#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lab/axes.hpp"
#include "core/lab/hold_search.hpp"
#include "core/lab/survey.hpp"

namespace substep {

/// A scene with the load and the seed of Experiment, as a run of the window starts it.
struct FindScene {
  std::shared_ptr<const Scene> plain;
  double load = 1.0;
  int seed = 0;

  friend bool operator==(const FindScene&, const FindScene&) = default;
};

/// "Find N": sub-steps and error of the paper's method along alpha, and the cheapest method within
/// an error, for any scene, in slices between frames.
///
/// The answer is that of `substep recommend`: the same runs (all_methods()), the same reference and
/// the same choice. It takes less time because a run ends early once it can no longer be the
/// answer: its largest error so far is above the limit, or its work so far is more than that of the
/// cheapest complete run within the limit. Both only grow during a run. The runs along alpha are
/// always completed. Unlike `recommend`, it does not search between the alphas.
class FindN {
 public:
  enum class Stage : unsigned char {
    kIdle,
    kSurvey,     // which body moves farthest, whether bodies touch
    kSubsteps,   // N along alpha, while there is no reference
    kReference,  // for errors of the path
    kMethods,    // all runs
    kWhole,      // the cheapest run, for the whole duration of the scene
    kDone
  };
  /// A run of the paper's method.
  struct AlphaPoint {
    double alpha = 0.0;
    double n = 0.0;  // mean sub-steps per frame, until it fails
    bool holds = true;
    std::optional<double> error;
    const Result* result = nullptr;  // never null; valid until advance() or start()
  };
  /// The runs so far.
  struct Count {
    std::size_t planned = 0;
    std::size_t complete = 0;
    std::size_t held = 0;   // of the complete ones
    std::size_t error = 0;  // ended early: above the limit of the error
    std::size_t cost = 0;   // ended early: more work than the cheapest one
  };

  /// Whether runs of the scene have this error, as far as its effects tell.
  [[nodiscard]] static bool has(ErrorAxis axis, const Scene& scene);
  /// Starts a search. Results of the same scene and error are kept as far as they are valid for the
  /// new limit.
  /// @param limit of the error [m, J], > 0
  void start(const FindScene& of, ErrorAxis axis, double limit);
  /// Stops before the next frame. Keeps the results so far.
  void cancel() { cancelled_ = true; }
  /// Computing time per frame of the window [s]. @param drawing time of the last frame without its
  /// slice [s]
  [[nodiscard]] static double slice(double drawing);
  /// Continues for about this long.
  void advance(double seconds);

  [[nodiscard]] bool busy() const {
    return stage_ != Stage::kIdle && stage_ != Stage::kDone && !cancelled_;
  }
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  [[nodiscard]] Stage stage() const { return stage_; }
  [[nodiscard]] double progress() const { return progress_; }  ///< 0 to 1
  /// Why there is no answer, or "".
  [[nodiscard]] const std::string& failure() const { return failure_; }

  [[nodiscard]] const FindScene& of() const { return of_; }
  /// The scene that the runs start from; null before the first start.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  [[nodiscard]] ErrorAxis axis() const { return axis_; }
  [[nodiscard]] double wanted() const { return wanted_; }  ///< limit as given [m, J]
  /// The limit that applies: a larger one if the reference is too uncertain for the wanted one.
  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] double compared() const { return compared_; }  ///< duration of all runs [s]
  [[nodiscard]] double whole() const { return whole_; }        ///< of the best run [s]
  /// Source "" while there is none.
  [[nodiscard]] const Reference& reference() const { return reference_; }
  /// What changes the energy of the true motion, so that less drift is not less error; or "".
  [[nodiscard]] const std::string& energy_changes() const { return energy_changes_; }
  /// The body whose path is compared, if the scene tracks none itself; or "".
  [[nodiscard]] const std::string& chosen_body() const { return chosen_body_; }

  /// By descending alpha: those that have run so far.
  [[nodiscard]] std::vector<AlphaPoint> along_alpha() const;
  /// Number of those planned.
  [[nodiscard]] std::size_t alphas() const { return curve_.size(); }
  [[nodiscard]] Count count() const;
  /// The answer, once done.
  [[nodiscard]] const Result* best() const;
  /// The cheapest run within the limit so far, which may still be replaced.
  [[nodiscard]] const Result* best_so_far() const;
  /// Of all runs that hold, the one with the smallest error.
  [[nodiscard]] const Result* nearest() const;
  /// The cheapest run of the paper's method within the limit.
  [[nodiscard]] const Result* best_of_paper() const;
  /// Cheaper runs within the limit that do not hold or stay within it for the whole duration.
  [[nodiscard]] const std::vector<Result>& failed() const { return failed_; }

  // What the user asks for next.
  ErrorAxis next_axis = ErrorAxis::kTrajectory;
  /// Largest error allowed, per axis [m, J].
  std::array<double, static_cast<std::size_t>(ErrorAxis::kCount)> next_limit{1e-3, 1.0, 1e-3, 1e-3};

 private:
  /// The state of an experiment.
  struct Try {
    enum class End : unsigned char { kNone, kComplete, kError, kCost };
    End end = End::kNone;
    double reached = 0.0;  // the error or cost at which it ended early
    bool on_curve = false;
    bool fails_whole = false;  // tried for the whole duration
  };

  void step();
  void begin_runs();
  void step_substeps();
  void step_reference();
  void step_methods();
  void step_whole();
  void plan();
  [[nodiscard]] bool matters(std::size_t index) const;
  void take(Result result);
  void update_bounds();
  void finish(std::string why = "");
  void note_progress();
  [[nodiscard]] std::optional<std::size_t> cheapest() const;
  [[nodiscard]] bool reference_serves(double limit) const;

  FindScene of_;
  std::shared_ptr<const Scene> scene_;
  ErrorAxis axis_ = ErrorAxis::kTrajectory;
  double wanted_ = 0.0;
  double limit_ = 0.0;
  double compared_ = 0.0;
  double whole_ = 0.0;
  Stage stage_ = Stage::kIdle;
  bool cancelled_ = false;
  double progress_ = 0.0;
  std::string failure_;
  std::string energy_changes_;
  std::string chosen_body_;

  std::optional<Survey> survey_;
  std::optional<ReferenceRun> finding_;
  std::string first_source_;  // of the reference before it is refined
  Reference reference_;

  std::vector<Experiment> experiments_;
  std::vector<Try> tries_;          // by experiment
  std::vector<std::size_t> curve_;  // experiments of the paper's method, by descending alpha
  std::vector<Result> preview_;     // of the curve, without errors
  std::vector<Result> results_;     // complete, in the order of the experiments
  std::vector<std::size_t> ids_;    // their experiments
  std::vector<std::size_t> queue_;
  std::size_t next_ = 0;  // in queue_
  std::unique_ptr<ExperimentRun> run_;
  std::size_t running_ = 0;   // its experiment
  std::int64_t checked_ = 0;  // its last frame at which it was checked
  double least_error_ = 0.0;  // of the complete runs
  double least_cost_ = 0.0;   // of the complete runs within the limit
  std::optional<HoldSearch> trial_;
  std::size_t on_trial_ = 0;  // its experiment
  std::vector<Result> failed_;
  std::optional<std::size_t> found_;  // its experiment
};

}  // namespace substep
