#pragma once

#include <cstdint>
#include <limits>

#include "core/model/effects.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {

/// How a frame ended.
enum class StepStatus : std::uint8_t {
  kOk,
  kNotFinite,  // a kinetic energy or K overflowed; the state is that of the last finite sub-step
  kTooManyContacts,  // detector.hpp; the state is that of the last sub-step within the limit
  kOverBudget,  // the next sub-step, or the frame, would exceed Simulator::budget(); the state is
                // that of the last sub-step taken
  kInvalid,     // an input was rejected: Simulator::problems()
};

/// The resources that a frame over budget would have needed.
struct Overrun {
  double memory = 0.0;  // [bytes]; 0 if the work was exceeded
  double work = 0.0;    // of the whole frame, or of the sub-step [floating-point operations]; 0 if
                        // the memory was exceeded
  double budget = 0.0;  // the limit that was exceeded [bytes, operations or contacts]
  bool of_substep = false;    // the work of one sub-step was exceeded
  std::int64_t contacts = 0;  // of the rejected sub-step
  std::int64_t rows = 0;      // of joints, contacts, friction and the grab
  std::int64_t bodies = 0;    // moving
  int substeps = 0;           // of the whole frame, including those not yet taken
  int iterations = 0;         // per sub-step; 0 for the direct solver
};

/// Rows by kind.
struct RowCounts {
  std::int64_t joint = 0;
  std::int64_t contact = 0;  // normals
  std::int64_t friction = 0;
  std::int64_t grab = 0;  // the spring of a Grab

  RowCounts& operator+=(const RowCounts& other) {
    joint += other.joint;
    contact += other.contact;
    friction += other.friction;
    grab += other.grab;
    return *this;
  }
  friend bool operator==(const RowCounts&, const RowCounts&) = default;
};

/// Solver statistics, summed over the sub-steps of a frame.
struct SolverWork {
  std::int64_t solves = 0;
  std::int64_t impacts = 0;      // of these: simultaneous impacts, propagated within a sub-step
  RowCounts rows;                // of all solves; PGS visits each row once per iteration
  std::int64_t iterations = 0;   // sweeps of PGS and XPBD, steps of Newton
  std::int64_t row_updates = 0;  // PGS and XPBD: rows visited
  std::int64_t pivots = 0;       // BPP: changes of the active set
  std::int64_t passes = 0;       // BPP: refreshes of the friction bounds, the first included
  std::int64_t factorisations = 0;
  std::int64_t flops = 0;      // floating-point operations of the solver, machine-independent
  std::int64_t unsettled = 0;  // BPP: friction bounds not settled after four passes
  std::int64_t unsolved = 0;   // solves that reached the limit of pivots (BPP) or steps (Newton)
  double residual = 0.0;       // of the last sub-step: largest violation of bounds [N s] and
                               // complementarity [m/s]
};

/// Cost of the criterion: all evaluations of K, its column norms and r.
struct CriterionWork {
  std::int64_t evaluations = 0;
  std::int64_t flops = 0;  // counted as for the solver

  CriterionWork& operator+=(const CriterionWork& other) {
    evaluations += other.evaluations;
    flops += other.flops;
    return *this;
  }
  friend bool operator==(const CriterionWork&, const CriterionWork&) = default;
};

/// Wall time by stage [s]; 0 for stages that the scene does not use.
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

/// Which stages ran in a frame: those of the effects, none if all bodies sleep, and others.
struct StagesRun : Effects {
  bool stiffness = false;
  bool effective_mass = false;  // a mode replaced M by Mt
  bool probe = false;
};

/// Optional measurements in a frame's report. Disabled measurements take no time and are NaN in the
/// report.
struct Measures {
  bool energies = true;
  bool errors = true;  // of constraints, and the residual of the last solve
  bool stages = true;  // wall time by stage; the total is always measured
};

/// The outputs of a frame: the only source for plots, CSV, verdicts and scripts.
struct FrameReport {
  std::int64_t frame = 0;  // frames completed
  double time = 0.0;       // [s], end of the frame, or of the last finite sub-step if it failed
  StepStatus status = StepStatus::kOk;
  int failed_body = -1;  // first body with a non-finite number
  Overrun overrun;       // valid for status kOverBudget

  int n_substeps = 0;   // taken in this frame; maximum over islands
  double n_mean = 0.0;  // mean number of sub-steps per moving body
  int islands = 0;      // 0 if islands are not detected
  int asleep = 0;       // bodies of sleeping islands, not stepped in this frame
  int n_wanted = 1;     // by Eq. 11 before the cap
  int attempts = 1;     // at this frame: Settings::redo
  int n_discarded = 0;  // sub-steps of all attempts but the last; maximum over islands of each
  bool capped = false;  // n_wanted exceeded the cap
  double dt_min = 0.0;  // shortest sub-step [s]
  double dt_max = 0.0;  // longest sub-step [s]
  double dt_stable = std::numeric_limits<double>::infinity();  // 2 sqrt(alpha/r), Eq. 10, at the
                                                               // end of the frame [s]
  StiffnessLeader leader;    // at the end of the frame: determines N of the next one; none if K was
                             // not evaluated
  double r_stiffness = 0.0;  // geometric stiffness of the leader, Eq. 9 [1/s^2]
  double r_rotation = 0.0;   // rotation and gyroscopic rate of the fastest-spinning body [1/s^2]
  int rotation_body = -1;    // that body; -1 if none spins or the setting is off

  double kinetic = 0.0;    // synchronised with the positions [J]
  double potential = 0.0;  // gravity and constant forces [J]
  double elastic = 0.0;    // in compliant joints of the last sub-step, soft contacts, springs [J]
  double springs = 0.0;    // of it, in springs and in joints whose oscillation a frame resolves [J]
  double energy = 0.0;     // kinetic + potential + springs [J]
  double parting = 0.0;    // potential energy added in this frame by parting overlaps [J]
  int lowered = 0;         // impacts whose e was lowered, because Newton's law would add energy
  double lowered_to = 1.0;        // the smallest share of e that was left [-]
  double constraint_error = 0.0;  // sum of |phi| of joint rows, springs excepted [m, rad]
  double joint_gap = 0.0;         // largest gap of a joint that is no spring [m]
  int joint_gap_joint = -1;       // index of that joint
  double torn = 0.0;              // largest gap of a joint, of the gap at which it is torn [-]
  int torn_joint = -1;            // index of that joint
  double penetration = 0.0;       // largest overlap of a contact, >= 0 [m]
  double inside = 0.0;            // largest overlap of a pair, of the width of the smaller body [-]
  int inside_a = -1;              // that pair
  int inside_b = -1;

  int joint_rows = 0;     // in the last sub-step
  int contact_rows = 0;   // normals, in the last sub-step
  int friction_rows = 0;  // in the last sub-step
  SolverWork work;
  CriterionWork criterion;
  std::int64_t visits = 0;  // bodies, rows, pairs and stored forces looked at outside the solver
  StageTimes times;
  StagesRun stages;
};

}  // namespace substep
