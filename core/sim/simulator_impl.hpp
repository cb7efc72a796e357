#pragma once
// What a Simulator is made of: the stages that its scene calls for, and scratch.

#include <memory>
#include <optional>
#include <vector>

#include "core/constraints/contact_stage.hpp"
#include "core/constraints/joint_stage.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/constraints/restitution_stage.hpp"
#include "core/sim/islands.hpp"
#include "core/sim/schedule.hpp"
#include "core/sim/simulator.hpp"
#include "core/sim/stage_clock.hpp"
#include "core/solver/solver.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/stiffness_bound.hpp"

namespace substep {

struct Simulator::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);
  Impl(std::shared_ptr<const Scene> scene_in, Start start);

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
  void remember_stiffness();
  void advance_poses(double dt, FrameReport& report);
  void synchronise(double dt);  // velocities that stand half a sub-step behind the poses

  // Of the sub-step: what moves in it, and its rows.
  const Part& part() const { return open ? schedule.part() : all; }
  std::span<Block> rows() { return blocks.from(first_block); }
  bool holds_grab() const { return grab && part().holds(grab->body); }
  double impulse_time_of(const Block& block) const;  // lambda = impulse / it [s]
  double dt_previous_of(const Block& block) const;
  void set_lambda(Block& block) const;  // where somebody is going to read it

  static RowCounts count_rows(std::span<const Block> of);
  bool probe_due() const;
  void probe(FrameReport& report);
  bool forces_are_stored() const;  // of any constraint, from sub-step to sub-step
  void seed_forces();
  void store_forces();
  // Where extrapolates(): what goes on changing as it did.
  void extrapolate(const StoredForce& force, Block& block) const;
  void find_rates(const Block& block, StoredForce& force) const;
  std::span<const Vec6> extrapolated_velocities();
  void store_accelerations(double dt);
  // Where follows_accelerations():
  void hand_over(double dt);                         // to sub-steps of another length
  void aim_at_poses(double dt);                      // bias and softness of joints
  std::span<const Vec6> pose_velocities(double dt);  // what poses move by; elsewhere u
  void begin_frame();
  void turn_axes(std::span<const int> bodies);  // R_WB
  void deal_out(FrameReport& report);           // the sub-steps of the frame to come
  void deal_out_islands(FrameReport& report);
  bool is_at_rest(std::span<const int> island) const;
  void put_to_rest(std::span<const int> island);
  void keep_forces_at_rest();
  void time_rest();
  FrameReport end(StageClock& wall);  // of a call: closes the frame where it is done
  void close(FrameReport& report);
  void observe(const Measures& asked, FrameReport& report);

  std::shared_ptr<const Scene> scene;
  Settings settings;
  Measures measures;
  State state;
  StartReport start;
  std::optional<Grab> grab;
  std::optional<FrameReport> open;  // of a frame of which some sub-steps are taken
  Schedule schedule;                // of the open frame
  bool contacts_foreseen = false;   // those of the open frame
  FrameReport stopped;              // the report of the frame that failed

  Part all;               // of the scene
  double heaviest = 1.0;  // largest mass or moment of inertia that moves, at least 1 [kg, kg m^2]
  std::unique_ptr<Islands> islands;  // built when they are first asked for

  // Stages: null where the scene does not call for the effect.
  std::unique_ptr<JointStage> joints;
  std::unique_ptr<ContactStage> contact;
  std::unique_ptr<FrictionStage> friction;
  std::unique_ptr<RestitutionStage> restitution;
  std::unique_ptr<StiffnessStage> stiffness;  // built when a mode or a view first needs K
  std::unique_ptr<Solver> solver;

  // Of every part that has moved in the frame, as its last sub-step left them.
  Blocks blocks;
  std::vector<StoredForce> forces;
  std::size_t first_block = 0;  // of the part that moves
  std::size_t first_force = 0;
  std::int64_t substeps_of_bodies = 0;  // of all that move, added up

  std::vector<InertiaInverse> inertia_inverse;  // of the bodies of the scene

  // Scratch, valid within a sub-step.
  std::vector<Mat3> R_WB;  // of bodies that stand still since the frame began
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u_start;         // at the start of the sub-step
  std::vector<Vec6> u_before;        // after the gyroscopic torque, before forces and constraints
  std::vector<Vec6> u_guess;         // where accelerations stay as they are, or change as they did
  std::vector<Motion> motions;       // and how bodies would move by that
  std::vector<Vec6> w;               // what they move by
  std::vector<double> impulse_time;  // per body: external forces act for it [s]
  bool smooth = true;                // no contact closed in this sub-step
  bool watched = true;               // whether anybody may look at what it leaves
  StiffnessBound bound;
  StageClock clock;
};

}  // namespace substep
