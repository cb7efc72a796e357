#pragma once
// Implementation of Simulator: the stages required by its scene, and scratch.

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/constraints/contact_stage.hpp"
#include "core/constraints/joint_stage.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/constraints/restitution_stage.hpp"
#include "core/sim/budget.hpp"
#include "core/sim/islands.hpp"
#include "core/sim/refused.hpp"
#include "core/sim/schedule.hpp"
#include "core/sim/simulator.hpp"
#include "core/sim/stage_clock.hpp"
#include "core/solver/solver.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/rotation_bound.hpp"
#include "core/stepping/stiffness_bound.hpp"

namespace substep {

struct Simulator::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);
  Impl(std::shared_ptr<const Scene> scene_in, Start start);

  /// The requested share of a frame.
  struct Share {
    int most = std::numeric_limits<int>::max();             // sub-steps to take, >= 1
    double work = std::numeric_limits<double>::infinity();  // no further sub-step once it is spent
    [[nodiscard]] bool whole() const { return std::isinf(work); }  // or its end state is displayed
  };
  /// Continues the open frame, or begins one.
  FrameReport advance(Share share);

  // The parts of a sub-step, in the order in which advance() calls them. Those that return
  // bool return false on failure; the report's status holds the reason.
  void begin_substep(FrameReport& report);
  bool append_rows(FrameReport& report);
  bool append_contacts();                                // false if there are too many
  void external_forces(double dt, FrameReport& report);  // u := Mt^-1 (M u + dt f), Mt^-1
  bool solve(double dt, FrameReport& report, bool probing = false);
  void count_work(const SolveReport& solved, FrameReport& report);
  bool breaks_motion(const Block& touching) const;
  bool finite(FrameReport& report);
  void stop(std::size_t body, FrameReport& report);  // the body with a non-finite number
  // over_budget.cpp
  FrameProgress progress(const FrameReport& report) const;
  bool within_budget(FrameReport& report);
  void refuse_solve(const SolveReport& solved, double dt, FrameReport& report);
  void stop_over_budget(Overrun over, FrameReport& report);
  bool evaluate_stiffness(FrameReport& report);
  void remember_stiffness();
  void advance_poses(double dt, FrameReport& report);
  // Velocities half a sub-step behind the poses: synchronise.cpp.
  void find_struck();
  void synchronise(double dt);
  void turn_joint_forces(double dt);
  void synchronise_spin(std::size_t body, double ahead, const Vec3& bent, double dt);
  void keep_finite(std::size_t body);
  bool extends_changes() const;
  void extend_changes(double dt);
  void extend_courses(double dt);

  // The bodies and rows of the current sub-step.
  const Part& part() const { return open ? schedule.part() : all; }
  std::span<Block> rows() { return blocks.from(first_block); }
  bool holds_grab() const { return grab && part().holds(grab->body); }
  double impulse_time_of(const Block& block) const;  // lambda = impulse / it [s]
  double dt_previous_of(const Block& block) const;
  void find_lambda(const Block& block, double* lambda) const;  // per row, from the impulses

  // For bodies with unequal moments of inertia: rotation.cpp.
  bool turns_otherwise(std::size_t body) const;  // differently from what torques alone give
  bool tumbles(std::size_t body) const;          // and conserves its angular momentum
  struct Spin {                                  // about the principal axes [N m s]
    Vec3 momentum = Vec3::Zero();                // at the start of the sub-step
    Vec3 predicted = Vec3::Zero();               // dt/2 of the gyroscopic torque in it
    Vec3 omega = Vec3::Zero();                   // predicted, world [rad/s]
    bool out_of_axis = false;                    // false: it rotates about a principal axis
    bool damped = false;                         // its momentum is not kept
  };
  void gyroscopic_torques(double dt);  // into u, before the solve
  void resize_torques();
  void predict_gyroscopic(double dt);
  bool bends_rows() const;
  bool closes_loops();  // true if the part has more joints than bodies
  bool any_out_of_axis() const;
  void bend_rows(double dt);          // of joints, for the rotation of their bodies
  static void meet(Block& joint);     // in one point
  void settle_gyroscopic(double dt);  // after the solve
  void carry_momentum(double dt);     // Störmer: u of tumbling bodies is I^-1 l in the solve
  void settle_momentum(double dt);    // and an angular velocity after it
  Vec3 momentum_of(std::size_t body, const Vec6& u) const;  // while it is I^-1 l [N m s]
  Vec3 velocity_of(std::size_t body, const Vec3& l) const;  // I^-1 l [rad/s]
  Vec3 torque_of(std::size_t body) const;                   // of this sub-step, world [N m]
  Vec3 turn_velocity(std::size_t body, const Vec3& l, const Vec3& torque, double dt) const;

  static RowCounts count_rows(std::span<const Block> of);
  bool propagate_impacts(double dt, FrameReport& report);  // impacts.cpp
  bool probe_due() const;
  void probe(FrameReport& report);
  bool forces_are_stored() const;   // of any constraint, between sub-steps
  bool springs_are_stored() const;  // of joints
  void set_joint_springs(double dt);
  bool averages_contacts() const;  // spring forces are averaged over the poses of a sub-step
  void set_contact_springs(double dt);
  SubstepTimes times_of(const Block& block, double dt) const;
  void seed_forces();
  void store_forces();
  // If extrapolates(): quantities continued at their last rates.
  void extrapolate(const StoredForce& force, Block& block) const;
  void find_rates(const Block& block, StoredForce& force) const;
  std::span<const Vec6> extrapolated_velocities();
  void prepare_courses();
  void store_accelerations(double dt);
  void store_changes(std::size_t body, const Vec6& a, double dt);
  // If follows_accelerations(): first_changes.cpp.
  struct Accelerations {
    std::vector<Vec6> a;                               // per body [m/s^2, rad/s^2]
    std::vector<Vec3> torque;                          // per tumbling body, world [N m]
    std::vector<std::array<double, kMaxRows>> lambda;  // per block of the part [N, N m]
  };
  bool needs_first_changes() const;
  void find_first_changes(double dt);
  void find_accelerations(double dt, double s, std::span<const Vec6> a, std::span<const Vec6> rate,
                          Solver& linear, Accelerations& out);
  void store_first_rates(double dt, const Accelerations& before, const Accelerations& at_start,
                         const Accelerations& after);
  // carry.cpp
  void correct_velocity_for_step_change(double dt);  // for a new step length
  void aim_at_poses(double dt);                      // bias and softness of joints
  std::span<const Vec6> pose_velocities(double dt);  // velocities that move the poses
  void begin_frame();
  void turn_axes(std::span<const int> bodies);  // R_WB
  void schedule_substeps(FrameReport& report);  // of the next frame
  void schedule_islands(FrameReport& report);
  bool heeds_rotation() const;                                      // true if N depends on rotation
  RotationBound rotation_bound(std::span<const int> bodies) const;  // zero if the setting is off
  double r_rotation_again() const;  // of the part, if N is re-evaluated after every sub-step
  bool is_at_rest(std::span<const int> island) const;
  void put_to_rest(std::span<const int> island);
  void keep_forces_at_rest();
  void time_rest();
  FrameReport refusal();  // report of a frame not begun because of a rejected input
  FrameReport end(StageClock& wall, bool looked_at);  // ends a call; closes a completed frame
  void close(FrameReport& report);
  void look(FrameReport& report);  // takes the selected `measures`
  /// @param axes R_WB of all bodies, if errors are requested  @param detector null without contact
  void observe(const Measures& asked, std::span<const Mat3> axes, Detector* detector,
               FrameReport& report) const;

  std::shared_ptr<const Scene> scene;
  Settings settings;
  Measures measures;
  Budget budget;
  Refused refused;
  State state;
  StartReport start;
  std::optional<Grab> grab;
  std::optional<FrameReport> open;  // report of a frame in progress
  Schedule schedule;                // of the open frame
  bool contacts_predicted = false;  // those of the open frame
  FrameReport stopped;              // the report of the frame that failed

  Part all;                          // of the scene
  bool has_springs = false;          // compliant joints
  double heaviest = 1.0;             // largest mass or moment of a moving body, >= 1 [kg, kg m^2]
  std::unique_ptr<Islands> islands;  // built on first use

  // Stages: null if the scene does not use the effect.
  std::unique_ptr<JointStage> joints;
  std::unique_ptr<ContactStage> contact;
  std::unique_ptr<FrictionStage> friction;
  std::unique_ptr<RestitutionStage> restitution;
  std::unique_ptr<StiffnessStage> stiffness;  // built when K is first needed
  std::unique_ptr<RotationCriterion> rotation;
  std::unique_ptr<Solver> solver;
  std::unique_ptr<Solver> impacts;  // built on first use

  // Rows and forces of every part stepped in the frame, after its last sub-step.
  Blocks blocks;
  std::vector<StoredForce> forces;
  std::size_t first_block = 0;  // of the current part
  std::size_t first_force = 0;
  std::int64_t substeps_of_bodies = 0;  // summed over moving bodies

  std::vector<InertiaInverse> inertia_inverse;  // of the bodies of the scene

  // Scratch, valid within a sub-step.
  std::vector<Mat3> R_WB;  // for bodies at rest: set at the start of the frame
  std::vector<InverseMass> inverse_mass;
  std::vector<InverseMass> rigid_mass;  // for impacts, in modes that replace M
  std::vector<Vec6> u_start;            // at the start of the sub-step
  std::vector<Vec6> u_before;   // after the gyroscopic torque, before forces and constraints
  std::vector<Vec6> u_guess;    // extrapolated, with constant or linearly changing accelerations
  std::vector<Motion> motions;  // motions predicted from u_guess
  std::vector<Vec6> w;          // velocities that move the poses
  std::vector<Spin> spins;      // of what tumbles
  bool loops_bend = false;      // the rows of all their joints are bent in this sub-step
  std::vector<Vec6> bent_push;  // change of the impulses of joints as bodies move [N s, N m s]
  struct Changes {              // per body, over dt; of the torque for tumbling bodies
    Vec6 a = Vec6::Zero();
    Vec6 now = Vec6::Zero();
    Vec6 before = Vec6::Zero();
  };
  std::vector<Changes> changes;        // if follows_accelerations()
  std::vector<BodyCourse> courses;     // if extrapolates()
  std::vector<Vec3> momentum_inertia;  // principal moments of tumbling bodies, else 0
  std::vector<double> impulse_time;    // per body: duration of external forces [s]
  std::vector<std::uint8_t> hit;       // per body: an impact of this sub-step reached it
  bool smooth = true;                  // no contact closed in this sub-step
  bool outputs_needed = true;          // of this sub-step
  StiffnessBound bound;
  StageClock clock;
};

}  // namespace substep
