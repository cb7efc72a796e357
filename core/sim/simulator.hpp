#pragma once

#include <memory>
#include <optional>

#include "core/model/budget.hpp"
#include "core/model/grab.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/constraint_forces.hpp"
#include "core/sim/report.hpp"
#include "core/sim/start.hpp"

namespace substep {

/// Steps one scene. Scene is const, State is a value, Settings may change between frames.
///
/// All inputs are checked (model/validate.hpp). Invalid input is rejected and leaves the simulator
/// unchanged: step() and substep() do nothing and return kInvalid, and problems() holds the reason,
/// until a valid input replaces it.
class Simulator {
 public:
  /// @param scene if it is null or fails check_values(), scene() is empty
  explicit Simulator(std::shared_ptr<const Scene> scene);
  ~Simulator();
  /// The moved simulator is then like one without a scene; another can be assigned to it.
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// One displayed frame of length scene().frame: Algorithm 1 of the paper. Completes a frame begun
  /// by substep(). Never throws. After a status other than kOk the state is that of the last finite
  /// sub-step and further calls do nothing.
  FrameReport step();
  /// One sub-step. The state between two sub-steps of a frame is for display only: snapshots are
  /// valid only between frames. @return report of the frame so far; complete after the last
  /// sub-step
  FrameReport substep();
  /// Part of a frame, for callers that must stay responsive: takes at least one sub-step, and stops
  /// once `work` is spent. The result is bitwise equal to step(). The report of an incomplete frame
  /// holds only work and status, and its state must not be displayed. @param work [operations]
  FrameReport step_some(double work);
  /// Remaining sub-steps of a frame begun by either, as currently planned; 0 between frames.
  [[nodiscard]] int substeps_left() const;

  /// Problems of all rejected inputs; empty if there are none.
  [[nodiscard]] Problems problems() const;

  /// Limits of a frame. A frame stops with kOverBudget before the sub-step that would exceed them;
  /// FrameReport::overrun holds the cause.
  void set_budget(const Budget& budget);
  [[nodiscard]] const Budget& budget() const;

  /// Selects the measurements in frame reports (default: all). They do not affect the motion.
  void set_measures(const Measures& measures);

  /// Energies and errors of the current state, without stepping. Rows and work are 0.
  [[nodiscard]] FrameReport observe() const;

  /// Restores the initial state. Settings are kept.
  void reset();
  /// Errors found in the initial state, and their treatment by Scene::start.
  [[nodiscard]] const StartReport& start() const;

  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const State& state() const;
  /// Continues from a snapshot of the same scene; releases any grab.
  void set_state(State state);
  /// Sets or clears a grab on a moving body. It acts from the next sub-step and contributes to K
  /// like any joint.
  void set_grab(const std::optional<Grab>& grab);
  [[nodiscard]] const std::optional<Grab>& grab() const;
  /// Forces of the last sub-step; empty if no sub-step was taken since set_state().
  [[nodiscard]] ConstraintForces constraint_forces() const;

  [[nodiscard]] const Settings& settings() const;
  void set_settings(const Settings& settings);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace substep
