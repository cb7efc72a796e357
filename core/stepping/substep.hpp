#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/settings.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {

class Solver;
class TimeIntegrator;

/// What the motors or drives of joints can exert on a body.
struct MotorsOnBody {
  double force = 0.0;   // sum of the largest forces [N]
  double torque = 0.0;  // sum of the largest torques [N m]
  bool moves = false;   // a motor with a velocity, a drive or a spring: the body does not rest
};

/// The data of one sub-step, in the order in which its parts are computed. Vectors hold one element
/// per body of the scene; those of bodies outside `part` are not updated. State is separate: it
/// persists.
struct Substep {
  /// @param of outlives the sub-step
  explicit Substep(const Scene& of);

  // Constant.
  const Scene* scene;
  bool has_springs = false;                     // compliant joints
  std::vector<InertiaInverse> inertia_inverse;  // M^-1 about the principal axes
  std::vector<MotorsOnBody> motors_on;          // empty without motors and drives

  // The step to take.
  TimeIntegrator* integrator = nullptr;
  Solver* solver = nullptr;
  Settings settings;
  const Part* part = nullptr;  // bodies to move
  double dt = 0.0;             // [s]
  double planned_dt = 0.0;     // the longest planned since the first impact of the frame [s]
  bool probing = false;        // only the forces are kept
  bool outputs_needed = true;  // velocities at the time of the poses, forces

  // Set by its parts.
  std::vector<Mat3> R_WB;         // at its start, static bodies included
  std::vector<Vec6> u_start;      // at its start [m/s, rad/s]
  std::vector<double> dt_before;  // length of the last sub-step; 0 before the first [s]
  std::span<Block> rows;          // phi, J; later bias, softness, impulse
  std::size_t solved = 0;  // blocks that an earlier solve of this sub-step left with impulses
  SolveLimits limits;
  std::vector<MotorsOnBody> drives_on;    // forces and torques of drives; empty without any
  std::vector<double> impulse_time;       // duration of applied forces [s]
  std::vector<Vec6> u_before;             // after the gyroscopic torque, before forces and rows
  std::vector<Vec6> u_unstruck;           // u_before, without impacts; empty without armatures
  std::vector<InverseMass> inverse_mass;  // Mt^-1
  std::span<const std::uint8_t> struck;   // per block, if impacts were propagated; else empty
  // With contacts found along the motion (sim/swept.cpp), else empty; per body [m/s, rad/s].
  std::span<const Vec6> gain;   // velocity by the forces
  std::span<const Vec6> shift;  // of the motion beyond u
  bool smooth = true;           // no contact closed
};

/// u += time M^-1 f for the applied forces of the moving bodies. @param time per body [s]
/// @param u per body, world axes
void apply_forces(const Substep& sub, std::span<const double> time, std::span<Vec6> u);

/// Duration of a block's impulse: lambda = impulse / duration [s]. Bodies that have just made
/// contact may differ in it; the force between them is then nominal.
double impulse_time_of(const Substep& sub, const Block& block);

/// Length of the sub-step before this one, for the bodies of a block [s].
double dt_previous_of(const State& state, const Block& block);

/// Computes the forces of a block from its impulses. @param lambda out, per row [N, N m]
void find_lambda(const Substep& sub, const Block& block, double* lambda);

/// True if the spring forces of joints are carried from one sub-step to the next.
bool springs_are_stored(const Substep& sub);

}  // namespace substep
