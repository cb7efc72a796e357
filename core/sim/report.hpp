#pragma once

#include <cstdint>
#include <limits>

namespace substep {

/// How a frame ended.
enum class StepStatus : std::uint8_t {
  kOk,
  kNotFinite,        // a kinetic energy, or K, left the range of numbers; the state is that of the
                     // last finite sub-step
  kTooManyContacts,  // detector.hpp; the state is that of the last sub-step that had fewer
  kOverBudget,       // the next sub-step, or the frame, would take more than Simulator::budget();
                     // the state is that of the last sub-step taken
  kInvalid,          // something given to the simulator was refused: Simulator::problems()
};

/// What a frame would have taken, where it was over budget.
struct Overrun {
  double memory = 0.0;        // [bytes]; 0 where it was the work
  double work = 0.0;          // of the whole frame, or of the sub-step [floating-point operations];
                              // 0: it was the memory
  double budget = 0.0;        // which was passed [bytes, operations or contacts]
  bool of_substep = false;    // it was the work of one sub-step
  std::int64_t contacts = 0;  // of the sub-step that was not taken
  std::int64_t rows = 0;      // of joints, contacts, friction and a hand
  std::int64_t bodies = 0;    // that move
  int substeps = 0;           // of the frame, those to come included
  int iterations = 0;         // of a sub-step; 0 of the direct solver
};

/// The body and degree of freedom with the largest k/M at the end of a frame: what the next frame's
/// N goes by. body = -1 where K is zero or was not evaluated in the frame.
struct StiffnessLeader {
  int body = -1;
  int dof = 0;        // 0..2 along, 3..5 about the body's principal axes
  double k = 0.0;     // K_d,i [N/m or N m/rad]
  double mass = 0.0;  // M_ii [kg or kg m^2]
  double r = 0.0;     // k / mass [1/s^2]
};

/// Rows by kind.
struct RowCounts {
  std::int64_t joint = 0;
  std::int64_t contact = 0;  // normals
  std::int64_t friction = 0;
  std::int64_t grab = 0;  // a hand

  RowCounts& operator+=(const RowCounts& other) {
    joint += other.joint;
    contact += other.contact;
    friction += other.friction;
    grab += other.grab;
    return *this;
  }
  friend bool operator==(const RowCounts&, const RowCounts&) = default;
};

/// What the solver did, summed over the sub-steps of a frame.
struct SolverWork {
  std::int64_t solves = 0;
  std::int64_t impacts = 0;  // of these, simultaneous impacts that spread within a sub-step
  RowCounts rows;  // of all solves: what a kind of row costs, PGS visits each once an iteration
  std::int64_t iterations = 0;   // sweeps of PGS and XPBD, steps of Newton
  std::int64_t row_updates = 0;  // PGS and XPBD: rows visited
  std::int64_t pivots = 0;       // BPP: changes of the active set
  std::int64_t passes = 0;       // BPP: refreshes of the friction bounds, the first included
  std::int64_t factorisations = 0;
  std::int64_t flops = 0;      // floating-point operations of the solver, the same on every machine
  std::int64_t unsettled = 0;  // BPP: solves whose friction bounds still moved after four passes
  std::int64_t unsolved = 0;   // solves that ran out of pivots (BPP) or of steps (Newton)
  double residual = 0.0;       // of the last sub-step: largest violation of bounds [N s] and
                               // complementarity [m/s]
};

/// What the criterion costs: K, its column norms and r, as often as they were evaluated.
struct CriterionWork {
  std::int64_t evaluations = 0;
  std::int64_t flops = 0;  // counted as the solver's are

  CriterionWork& operator+=(const CriterionWork& other) {
    evaluations += other.evaluations;
    flops += other.flops;
    return *this;
  }
  friend bool operator==(const CriterionWork&, const CriterionWork&) = default;
};

/// Wall time by stage [s]. A stage that the scene does not call for stays 0.
struct StageTimes {
  double joints = 0.0;
  double contact = 0.0;
  double friction = 0.0;
  double grab = 0.0;
  double mass = 0.0;
  double solve = 0.0;
  double stiffness = 0.0;
  double integrate = 0.0;
  double total = 0.0;  // the whole frame
};

/// Which stages ran in a frame.
struct StagesRun {
  bool gravity = false;
  bool gyroscopic = false;
  bool joints = false;
  bool contact = false;
  bool friction = false;
  bool restitution = false;
  bool external = false;
  bool stiffness = false;
  bool effective_mass = false;  // a mode put another mass in the place of M
  bool probe = false;
};

/// What a frame's report measures beside the motion. Disabled measurements take no time, and are no
/// number in the report.
struct Measures {
  bool energies = true;
  bool errors = true;  // of constraints, and the residual of the last solve
  bool stages = true;  // wall time by stage; the total is always there
};

/// The outputs of a frame. Plots, CSV, verdicts and scripts read nothing else.
struct FrameReport {
  std::int64_t frame = 0;  // frames done
  double time = 0.0;       // [s], at the end of the frame; of a failed one, of its last finite
                           // sub-step
  StepStatus status = StepStatus::kOk;
  int failed_body = -1;  // where the first number that is not finite appeared
  Overrun overrun;       // of status kOverBudget

  int n_substeps = 0;   // taken in this frame, by the island that takes most
  double n_mean = 0.0;  // sub-steps of a moving body, in the mean
  int islands = 0;      // 0 where they are not looked for
  int asleep = 0;       // bodies of islands at rest, which no sub-step has moved
  int n_wanted = 1;     // by Eq. 11 before the cap
  bool capped = false;  // n_wanted was more than allowed
  double dt_min = 0.0;  // shortest sub-step [s]
  double dt_max = 0.0;  // longest sub-step [s]
  double dt_stable = std::numeric_limits<double>::infinity();  // 2 sqrt(alpha/r), Eq. 10, at the
                                                               // end of the frame [s]
  StiffnessLeader leader;                                      // that set the stiffness term of r
  double r_stiffness = 0.0;  // geometric stiffness, Eq. 9: the leader's [1/s^2]
  double r_rotation = 0.0;   // turn and gyroscopic rate of the body that spins fastest [1/s^2]
  int rotation_body = -1;    // that body; -1 where none spins or the setting is off

  double kinetic = 0.0;           // synchronised with the positions [J]
  double potential = 0.0;         // of gravity and of constant forces [J]
  double energy = 0.0;            // kinetic + potential [J]
  double constraint_error = 0.0;  // sum over joints of the 1-norm of phi [m, rad]
  double joint_gap = 0.0;         // largest distance between the anchors of a joint [m]
  int joint_gap_joint = -1;       // index of that joint
  double penetration = 0.0;       // largest overlap of a contact, >= 0 [m]

  int joint_rows = 0;     // in the last sub-step
  int contact_rows = 0;   // normals, in the last sub-step
  int friction_rows = 0;  // in the last sub-step
  SolverWork work;
  CriterionWork criterion;
  StageTimes times;
  StagesRun stages;
};

}  // namespace substep
