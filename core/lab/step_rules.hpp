#pragma once
// Exact limits of the time step for linear systems, as engines treat them.
//
// Semi-implicit Euler, v+ = v + h M^-1 f, q+ = q + h v+, with the part of stiffness and damping
// that is implicit evaluated at q+ and v+ and the rest at q and v, gives for q
//   (M + h D_i + h^2 K_i) q+ + (h^2 K_e + h D_e - 2 M - h D_i) q + (M - h D_e) q- = 0.
// For symmetric matrices, D_i, D_e, K_i >= 0 and K_e + K_i > 0, every root is inside the unit
// circle if and only if the matrix at the root -1 is positive definite,
//   4 M + 2 h (D_i - D_e) + h^2 (K_i - K_e) > 0.
// The geometric stiffness K_e of joints need not be definite: where it does not resist, bodies fall
// over at any step, and the condition is that of the directions in which it does.

#include <Eigen/Core>
#include <limits>

#include "core/math/types.hpp"

namespace substep {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Moves one coordinate of a joint. [kg m^2 and N m/rad, or kg and N/m]
struct OneCoordinate {
  double inertia = 1.0;           // > 0, armature included
  double stiffness = 0.0;         // explicit, >= 0
  double explicit_damping = 0.0;  // >= 0
  double implicit_damping = 0.0;  // >= 0
};

/// True if h^2 k + 2 h d_e < 4 I + 2 h d_i. @param h [s]
bool is_stable(const OneCoordinate& of, double h);
/// The largest step below which it is stable [s].
double largest_step(const OneCoordinate& of);

/// A law kp (target - x) - kd x' that is computed every n steps and held between them.
struct HeldDrive {
  double inertia = 1.0;    // > 0, armature included
  double stiffness = 0.0;  // kp >= 0
  double damping = 0.0;    // kd >= 0
  int steps = 1;           // n
};

/// True if n h (h kp + 2 kd) < 4 I and kd > kp h (n - 1)/2. @param h [s]
bool is_stable(const HeldDrive& of, double h);
/// The largest step below which the first holds, and the second [s].
double largest_step_of_effort(const HeldDrive& of);
double largest_step_of_delay(const HeldDrive& of);

/// The armature that makes a step stable, 0 if none is needed: h^2 k/4 + h (d_e - d_i)/2 - I.
double armature_for(const OneCoordinate& of, double h);

/// A linear system in some coordinates.
struct LinearSystem {
  Eigen::MatrixXd mass;       // positive definite
  Eigen::MatrixXd stiffness;  // K_e - K_i, symmetric
  Eigen::MatrixXd damping;    // D_i - D_e, symmetric; or empty
};

struct StepLimit {
  double step = kNoLimit;  // [s]
  Eigen::VectorXd mode;    // of mass 1: what fails first; empty without a limit
};

/// The largest step such that the condition holds for every smaller one.
StepLimit largest_step(const LinearSystem& of);

}  // namespace substep
