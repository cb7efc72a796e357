#pragma once
// Implementation of Simulator: the stages required by its scene, and scratch.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/constraints/contact_stage.hpp"
#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/joint_stage.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/constraints/swept_contacts.hpp"
#include "core/sim/islands.hpp"
#include "core/sim/lower_restitution.hpp"
#include "core/sim/schedule.hpp"
#include "core/sim/simulator.hpp"
#include "core/solver/solver.hpp"
#include "core/stepping/restitution_stage.hpp"
#include "core/stepping/rotation_bound.hpp"
#include "core/stepping/stiffness_bound.hpp"
#include "core/stepping/stored_forces.hpp"
#include "core/stepping/substep.hpp"
#include "core/stepping/time_integrator.hpp"

namespace substep {

/// Invalid inputs that a simulator rejected, by source. Each list is cleared when a valid input of
/// the same kind is set.
struct Refused {
  Problems scene;  // permanent: the scene cannot be replaced
  Problems state;
  Problems settings;
  Problems grab;
  Problems budget;

  [[nodiscard]] bool any() const { return !all().empty(); }
  [[nodiscard]] Problems all() const {
    Problems sum;
    for (const Problems* some : {&scene, &state, &settings, &grab, &budget}) {
      sum.insert(sum.end(), some->begin(), some->end());
    }
    return sum;
  }
};

/// Adds the time since the last call to the stage that has just ended.
class StageClock {
 public:
  /// A disabled clock adds nothing and never reads the system clock.
  explicit StageClock(bool runs = true) : runs_(runs) {
    if (runs_) last_ = Clock::now();
  }
  void lap(double& stage) {
    if (!runs_) return;
    const auto now = Clock::now();
    stage += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool runs_;
  Clock::time_point last_;
};

/// Errors of the rows of a joint at the end of a sub-step [m or rad].
struct RowGaps {
  double of[kMaxRows] = {};
};

struct Simulator::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);

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
  Substep& begin_substep(bool last_of_share, FrameReport& report);
  bool append_rows(Substep& sub, FrameReport& report);
  bool append_contacts(const Substep& sub);                 // false if there are too many
  void external_forces(Substep& sub, FrameReport& report);  // u := Mt^-1 (M u + dt f), Mt^-1
  bool solve(Substep& sub, FrameReport& report);
  void seed(const Substep& sub);
  void set_bias(Substep& sub, FrameReport& report);
  /// Sets the rows of motors, drives and dry friction. @param u velocities of the last sub-step
  /// [m/s, rad/s]
  void drive_motors(const Substep& sub, std::span<const Vec6> u) const;
  /// Its speed, and its bounds for an impulse of that duration [s].
  void set_motor(Block& row, double time) const;
  /// What a motor, a drive or dry friction changes of the velocities until the poses.
  void set_reaction(const Substep& sub, Block& row) const;
  /// Seeds rows, and sums what drives exert on bodies.
  void sum_drives(Substep& sub);
  bool solve_rows(Substep& sub, FrameReport& report);
  void set_softness(const Substep& sub, std::span<Block> rows) const;
  bool closes_joints(const Substep& sub) const;  // close_joints.cpp
  /// Repeats a solve until joints hold at the end. @param system its u* is u_star, by: its solver
  void close_joints(const Substep& sub, const System& system, Solver& by,
                    SolveReport& solved);  // close_joints.cpp
  void let_contacts_turn(const System& system);
  // impacts.cpp
  bool propagate_impacts(Substep& sub, FrameReport& report);
  bool solve_impacts(Substep& sub, std::span<Block> rows, std::span<Vec6> u,
                     std::span<const InverseMass> masses, FrameReport& report);
  std::span<const InverseMass> masses_of_impacts(const Substep& sub);
  bool lower_impacts(Substep& sub, std::span<const InverseMass> masses, FrameReport& report);
  /// @param u, u_plus before and after them  @param along_motion with the velocities that forces
  /// give until the contacts close
  [[nodiscard]] ContactWork work_of_contacts(const Substep& sub, std::span<const Block> rows,
                                             std::span<const Vec6> u, std::span<const Vec6> u_plus,
                                             bool along_motion) const;
  bool rebounds_add_energy(const Substep& sub);  // in the solve after them
  void lower_to(double share) {
    ++lowered;
    lowered_to = std::min(lowered_to, share);
  }
  Solver& impact_solver();
  // strike.cpp
  /// A sub-step that an impact ends looks further, of its length, for the time of the impact.
  static constexpr double kAhead = 1.002;
  bool solve_until_impact(Substep& sub, FrameReport& report);
  bool may_shorten(const Substep& sub) const;
  /// True if a contact that closes at this speed is an impact. @param approach [m/s]
  bool is_fast(const Substep& sub, const Block& contact, double approach) const;
  double speed_in_substep(const Substep& sub, const Block& contact) const;  // [m/s or rad/s]
  bool arrives(const Substep& sub, const Block& contact) const;  // fast, before the forces
  double width_of(const Block& contact) const;                   // [m or rad]
  double touching(const Block& contact) const;                   // the gap of bodies that touch [m]
  double closing_time(const Substep& sub, const Block& contact) const;
  void await_impacts(const Substep& sub, bool shortens);
  SweptContacts::Found settle_waiting(const Substep& sub, std::size_t solved,
                                      SweptContacts::Found found);
  bool strike(Substep& sub, FrameReport& report);
  void set_reactions(const Substep& sub, std::span<const Vec6> u, std::span<Block> rows);
  bool set_hits(const Substep& sub, std::span<const Vec6> u, double share, std::span<Block> rows);
  void start_from(Substep& sub, std::span<const Vec6> u_minus, std::span<const Vec6> u_plus);
  void set_dt_previous(int body, double dt);
  void close_struck(const Substep& sub) const;
  // swept.cpp
  /// Softness of contacts that are not springs, of the mobility of their rows.
  static constexpr double kRigidContact = 1e-5;
  bool sweeps_motion(const Substep& sub) const;  // contacts and limits are found along the motion
  /// True if rows may open and close.
  bool unilateral() const { return contact || (coordinates && coordinates->has_limits()); }
  bool solve_swept(Substep& sub, bool shortens, FrameReport& report);
  bool solve_softly(Substep& sub, FrameReport& report);
  bool solve_afresh(Substep& sub, FrameReport& report);
  SweptContacts::Found sweep(Substep& sub, double until);      // until [s], >= dt
  void add_reactions(const Substep& sub, std::size_t solved);  // to the gain; rows before the sweep
  bool too_many_swept() const;
  bool find_shift(Substep& sub, FrameReport& report);
  /// Of the last sub-step's rows that are not springs [J].
  [[nodiscard]] double stiff_elastic() const;
  /// The potential energy that the shift adds [J].
  [[nodiscard]] double lift_by_shift(const Substep& sub) const;
  bool parts(const Block& block) const;    // true if an overlap is parted
  bool is_deep(const Block& block) const;  // an overlap by more than bodies sink
  double parting_speed(const Substep& sub, const Block& row) const;
  double fastest_shift(const Substep& sub) const;
  /// True if a contact stops an approach that the forces of the sub-step do not explain: a body
  /// reaches the surface in one sub-step and comes to rest in the next.
  bool ends_impact(const Substep& sub, const Block& block) const;
  void predict_motions(const Substep& sub);  // w, motions
  void count_visits(const Substep& sub, FrameReport& report);
  void count_work(const Substep& sub, const SolveReport& solved, FrameReport& report);
  bool finite(const Substep& sub, FrameReport& report);
  void stop(const Substep& sub, int body, FrameReport& report);  // body with a non-finite number
  void keep_forces(const Substep& sub);
  /// Of the last sub-step, per block and row [N, N m].
  [[nodiscard]] std::vector<std::array<double, kMaxRows>> forces_of_blocks() const;
  bool evaluate_stiffness(const Substep& sub, FrameReport& report);
  void remember_stiffness(const Part& part);
  void advance_poses(const Substep& sub, FrameReport& report);
  bool holds_grab(const Substep& sub) const { return grab && sub.part->holds(grab->body); }
  static RowCounts count_rows(std::span<const Block> of);
  // over_budget.cpp
  int substeps_taken(const Substep& sub) const;
  int substeps_left(const Substep& sub) const;          // including this one
  double work_beside_solver(const Substep& sub) const;  // of this sub-step: bodies and rows
  double forecast_work(const Substep& sub, const FrameReport& report) const;  // of the whole frame
  SolveLimits limits_of_solve(const Substep& sub, const FrameReport& report) const;
  bool within_budget(Substep& sub, FrameReport& report);
  void refuse_solve(Substep& sub, const SolveReport& solved, FrameReport& report);
  void stop_over_budget(Substep& sub, Overrun over, FrameReport& report);
  void drop_rows(Substep& sub);

  // The start and end of a frame: frame.cpp, rest.cpp.
  void begin_frame();
  bool probe_due() const;
  void probe(FrameReport& report);
  void schedule_substeps(FrameReport& report);  // of the next frame
  void schedule_islands(FrameReport& report);
  SubstepClock clock_of(std::span<const int> moving, double r, double r_rotation) const;
  void begin_again(FrameReport& report);  // the frame, with the N that r_in_frame requires
  bool heeds_rotation() const;            // true if N depends on rotation
  RotationBound rotation_bound(std::span<const int> bodies) const;  // zero if the setting is off
  /// Updates r_in_frame after a sub-step. @return bound of the rotation criterion at its end, or of
  /// joints that did not close, 0 if nothing reads it [1/s^2]
  double watch_substep(const Substep& sub);
  bool is_at_rest(std::span<const int> island) const;
  void put_to_rest(std::span<const int> island);
  void keep_forces_at_rest();
  void time_rest();
  FrameReport refusal();  // report of a frame not begun because of a rejected input
  FrameReport end(StageClock& wall, bool looked_at);  // ends a call; closes a completed frame
  void carry_to_next_frame(const FrameReport& report);
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
  State before_frame;               // if it may be taken again
  std::vector<double> r_in_frame;  // per body: largest r of the open frame, of all attempts [1/s^2]
  bool contacts_predicted = false;  // those of the open frame
  FrameReport stopped;              // the report of the frame that failed

  Part all;                          // of the scene
  bool has_loops = false;            // joints form loops
  double heaviest = 1.0;             // largest mass or moment of a moving body, >= 1 [kg, kg m^2]
  std::unique_ptr<Islands> islands;  // built on first use

  // Stages: null if the scene does not use the effect.
  std::unique_ptr<JointStage> joints;
  std::unique_ptr<CoordinateStage> coordinates;
  std::unique_ptr<ContactStage> contact;
  std::unique_ptr<FrictionStage> friction;
  std::unique_ptr<RestitutionStage> restitution;
  std::unique_ptr<StiffnessStage> stiffness;  // built when K is first needed
  std::unique_ptr<RotationCriterion> rotation;
  std::unique_ptr<TimeIntegrator> integrator;
  std::unique_ptr<Solver> solver;
  std::unique_ptr<Solver> impacts;  // built on first use

  // Rows and forces of every part stepped in the frame, after its last sub-step.
  Blocks blocks;
  std::vector<StoredForce> forces;
  std::size_t first_block = 0;  // of the current part
  std::size_t first_force = 0;
  StoredForceIndex index_of_last_frame;  // of state.forces during a frame
  StoredForceIndex index_of_part;        // of the current part's forces
  std::int64_t substeps_of_bodies = 0;   // summed over moving bodies

  Substep current;             // the last one taken
  std::vector<Mat3> end_axes;  // R_WB after the sub-step, if errors or energies are measured
  std::vector<InverseMass> rigid_mass;  // for impacts, in modes that replace M
  std::vector<Vec6> u_star;             // before the rows act, if solves are repeated
  std::vector<Vec6> w;                  // velocities of the motion, likewise
  Motions motions;                      // of the sub-step, likewise
  std::vector<RowGaps> gaps;            // likewise, per block
  std::vector<RowGaps> corrected;       // by the last of them
  std::vector<double> openings;         // per block: of contacts by turning, likewise [m/s]
  bool joints_open = false;             // the sub-step is too long for them to close

  // With contacts found along the motion.
  std::unique_ptr<SweptContacts> swept;   // built on first use
  std::vector<Vec6> u_forced;             // after the forces, before rows and impacts
  std::vector<Vec6> u_unforced;           // before the forces and impacts
  std::vector<Vec6> u_rebounding;         // after impacts that add no energy, and forces
  bool separates = true;                  // what was struck
  double exchanged = 0.0;                 // by impacts of the last solve [J]
  int lowered = 0;                        // impacts of the last solve with a lower e
  double lowered_to = 1.0;                // their smallest share of e [-]
  std::vector<Vec6> gain;                 // by the forces of the sub-step
  std::vector<Vec6> shift;                // of the motion beyond u: impacts, overlaps [m/s, rad/s]
  double contact_softness = 0.0;          // of the mobility of a row [-]
  std::vector<Vec6> u_meeting;            // at the time of the poses, at the start
  std::vector<Vec6> u_arriving;           // likewise, with reactions, before the impacts
  Blocks impact_rows;                     // rows of impacts at the start of the sub-step
  double ends_at = 0.0;                   // an impact ends the sub-step [s]; 0: none
  double dt_before = 0.0;                 // State::dt_previous before a strike [s]
  std::vector<OwnSubstep> own_before;     // State::own, likewise
  std::vector<Vec6> acceleration_before;  // State::acceleration, likewise
  std::vector<Vec6> change_before;        // State::acceleration_change, likewise
  double whole_dt = 0.0;                  // length of the sub-step if no impact ends it [s]
  bool begins_with_impact = false;        // this sub-step begins with an impact
  int shortened = 0;                      // how often this sub-step was shortened
  SolveStatus last_solve = SolveStatus::kSolved;
  Blocks parting;  // rows that part overlaps

  StiffnessLeader bound;
  StageClock clock;
};

}  // namespace substep
