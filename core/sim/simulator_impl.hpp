#pragma once
// What a Simulator is made of: the stages that its scene calls for, and scratch.

#include <memory>
#include <optional>
#include <vector>

#include "core/constraints/contact_stage.hpp"
#include "core/constraints/joint_stage.hpp"
#include "core/constraints/restitution_stage.hpp"
#include "core/sim/simulator.hpp"
#include "core/sim/stage_clock.hpp"
#include "core/solver/solver.hpp"
#include "core/stepping/stiffness_bound.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {

struct Simulator::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);

  /// @param most sub-steps to take, >= 1; the frame that is open goes on, else one begins
  FrameReport advance(int most);

  // The parts of a sub-step, in the order in which advance() calls them. Those that can fail tell,
  // and leave the state and a status that says why.
  void begin_substep(FrameReport& report);
  bool append_rows(FrameReport& report);
  bool append_contacts();                                // false where there are too many
  void external_forces(double dt, FrameReport& report);  // u := Mt^-1 (M u + dt f), Mt^-1
  void solve(double dt, bool probing, FrameReport& report);
  bool finite(FrameReport& report);
  void stop(std::size_t body, FrameReport& report);  // of which a number is not finite
  bool evaluate_stiffness(FrameReport& report);
  void advance_poses(double dt, FrameReport& report);

  RowCounts rows_by_kind() const;
  bool probe_due() const;
  void probe(FrameReport& report);
  void seed_forces();
  void store_forces();
  void begin_frame();
  FrameReport end(StageClock& wall);  // of a call: closes the frame where it is done
  void close(const SubstepClock& clock, FrameReport& report);
  void observe(const Measures& asked, FrameReport& report);

  std::shared_ptr<const Scene> scene;
  Settings settings;
  Measures measures;
  State state;
  std::optional<Grab> grab;
  struct OpenFrame {
    SubstepClock substeps;
    FrameReport report;
  };
  std::optional<OpenFrame> open;   // a frame of which some sub-steps are taken
  bool contacts_foreseen = false;  // those of the open frame
  FrameReport stopped;             // the report of the frame that failed

  // Stages: null where the scene does not call for the effect.
  std::unique_ptr<JointStage> joints;
  std::unique_ptr<ContactStage> contact;
  std::unique_ptr<FrictionStage> friction;
  std::unique_ptr<RestitutionStage> restitution;
  std::unique_ptr<StiffnessStage> stiffness;  // built when a mode or a view first needs K
  std::unique_ptr<Solver> solver;

  // Scratch, valid within a sub-step.
  Blocks blocks;
  std::vector<Mat3> R_WB;
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u_start;   // at the start of the sub-step
  std::vector<Vec6> u_before;  // after the gyroscopic torque, before forces and constraints
  double impulse_time = 0.0;   // lambda = impulse / impulse_time [s]
  bool smooth = true;          // no contact closed in this sub-step
  StiffnessBound bound;
  StageClock clock;
};

}  // namespace substep
