#pragma once

#include <array>
#include <vector>

#include "core/constraints/joint_stage.hpp"
#include "core/solver/solver.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

// Störmer's method needs the change of accelerations, Numerov's the change of forces. Before the
// first sub-step they are computed from trial poses one sub-step before and after the start.

/// Motion and forces at one pose.
struct Accelerations {
  std::vector<Vec6> a;                               // per body [m/s^2, rad/s^2]
  std::vector<Vec3> torque;                          // per tumbling body, world [N m]
  std::vector<std::array<double, kMaxRows>> lambda;  // per joint of the part [N, N m]
};

struct FirstAccelerations {
  Accelerations before;  // at -dt
  Accelerations at_start;
  Accelerations after;  // at dt
};

/// Solves J a = -phi'' for the forces at the poses. @param sub with R_WB, inverse_mass and the rows
/// of joints, whose impulses are set  @param u velocities at these poses, per body [m/s, rad/s]
Accelerations accelerations(const Substep& sub, std::span<const Vec6> u, Solver& linear);

/// True before the first sub-step of a part on which only joints act: no contact is closed, no body
/// is grabbed.
bool needs_first_changes(const Substep& sub, const State& state);

/// @param sub with rotation matrices and rows  @param joints null without joints
FirstAccelerations first_accelerations(const Substep& sub, const State& state,
                                       const JointStage* joints, Solver& linear);

}  // namespace substep
