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

/// Steps one scene. Scene is const, State is a value, Settings may change between any two frames.
///
/// What it is given is checked (model/validate.hpp). What is invalid is not taken: the simulator
/// stays as it was, step() and substep() do nothing and return kInvalid, and problems() says why,
/// until something valid is given in its place.
class Simulator {
 public:
  /// @param scene where it is null or fails check_values(), scene() is an empty one
  explicit Simulator(std::shared_ptr<const Scene> scene);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// One displayed frame of length scene().frame: Algorithm 1 of the paper; what is left of it
  /// where substep() began one. Never throws. After a status other than kOk the state is that of
  /// the last finite sub-step and further calls do nothing.
  FrameReport step();
  /// One sub-step. The state between two sub-steps of a frame is to look at, not to keep: only from
  /// frame to frame is it a snapshot. @return of the frame so far; complete where none is left
  FrameReport substep();
  /// A part of a frame, for callers that must stay responsive: sub-steps until they have taken so
  /// much, at least one. The bits are those of step(). The report of an incomplete frame has its
  /// work and status alone, and its state is not one to look at. @param work [operations]
  FrameReport step_some(double work);
  /// Sub-steps that the frame begun by either still has, as decided so far; 0 between frames.
  [[nodiscard]] int substeps_left() const;

  /// What was given and refused; empty where all is well.
  [[nodiscard]] Problems problems() const;

  /// What a frame may take. Past it a frame stops with kOverBudget, before the sub-step that would
  /// take more: FrameReport::overrun names the cause.
  void set_budget(const Budget& budget);
  [[nodiscard]] const Budget& budget() const;

  /// What the reports of frames measure: everything by default. Nothing of it changes
  /// the motion.
  void set_measures(const Measures& measures);

  /// Energies and errors of the current state, without stepping. Rows and work are a frame's: 0
  /// here.
  [[nodiscard]] FrameReport observe() const;

  /// Back to the start. Settings stay.
  void reset();
  /// What was found at the scene's start, and done about it by Scene::start.
  [[nodiscard]] const StartReport& start() const;

  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const State& state() const;
  /// Goes on from a snapshot of the same scene; lets go of what was grabbed.
  void set_state(State state);
  /// A hand on a body that moves, or none. Acts from the next sub-step on, and is in K as any joint
  /// is.
  void set_grab(const std::optional<Grab>& grab);
  [[nodiscard]] const std::optional<Grab>& grab() const;
  /// Of the last sub-step; empty where the state was set and none has been taken since.
  [[nodiscard]] ConstraintForces constraint_forces() const;

  [[nodiscard]] const Settings& settings() const;
  void set_settings(const Settings& settings);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace substep
