#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/solver/system.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

// A compliant joint or contact is a spring: its force is -phi/C at the poses at which the
// integrator evaluates forces, not a drift correction. With the poses before, at and after the
// sub-step,
//   C lambda = -(w+ phi+ + w0 phi + w- phi-),   w+ + w0 + w- = 1,
// so that the static deflection is C lambda for any weights, dt and N. With phi+ = phi + dt J u+,
// phi- = phi - dt- J u- and the impulse p = t lambda, t the duration of the force, a row is
//   J u+ + C/(w+ dt t) p = -(phi - w- dt- J u-)/(w+ dt).
// On one degree of freedom with kappa = dt t/(C m) the recurrence is
//   (1 + w+ kappa) phi+ - (2 - w0 kappa) phi + (1 + w- kappa) phi- = 0,
// stable while w+ >= w- and 2 (w+ + w-) >= 1 - 4/kappa, and the amplitude decays by the share
// kappa (w+ - w-)/2 per sub-step. The weights are therefore
//   Euler, Newton's forces at the end   w+ = 1: implicit Euler, the paper's;
//   leapfrog, Newton's Numerov          w+ = w- = 1/12, Numerov's: of fourth order for one spring;
//   Newton's forces at the mean         w+ = w- = 1/4, average acceleration;
//   Störmer                             w+ = w- = 0: the force of the poses, given to the rows;
// and for springs too stiff to be resolved they blend into implicit Euler with
// sigma = kappa^2/(kappa^2 + 4): w+ - w- = sigma, which changes a resolved spring at fourth order
// in dt.
//
// A drive is a spring k = 1/C about its target, with a damper. Its row is always solved: with
// Störmer's method it has Numerov's weights. The damper's force is
//   -c (theta (J u+) + (1 - theta) J u),
// with the velocity at the poses between both sub-steps, theta = dt-/(dt- + dt) >= 1/4, blended
// into theta = 1 with a^2/(a^2 + 4), a = c t/m; implicit Euler has theta = 1. The recurrence of one
// degree of freedom
//   (1 + w+ kappa + theta a) phi+ - (2 - w0 kappa + (2 theta - 1) a) phi
//     + (1 + w- kappa - (1 - theta) a) phi- = 0
// has its roots within the unit circle for any k, c >= 0 and dt, as (1 - theta) a <= 1.

/// Weights of the poses ahead and behind, w+ and w-.
struct SpringWeights {
  double ahead = 1.0;
  double behind = 0.0;
};

/// Prescribes the impulse of a row, Block::given; the solve adds 1e-12 of what would keep the row
/// at `speed`. Relative to a speed of zero, this would damp the motion in each sub-step. Expressed
/// by softness and bias alone, the impulse would be a small difference of large numbers.
/// @param impulse [N s, N m s]  @param speed J u that is expected after the sub-step [m/s, rad/s]
void give_force(std::span<const InverseMass> inverse_mass, Block& joint, int row, double impulse,
                double speed = 0.0);

/// kappa of rows with a common compliance, in the direction of the largest mobility; 0 if nothing
/// moves. @param dt_t dt t [s^2]
double spring_kappa(double dt_t, std::span<const InverseMass> inverse_mass, const Block& joint,
                    int first, int end);
inline constexpr double kResolved = 0.25;  ///< Störmer prescribes spring forces up to this kappa

/// Weights of a spring whose force is not prescribed. @param kappa as spring_kappa()
SpringWeights solved_weights(const Settings& settings, double kappa);
/// True if compliant rows do not use implicit Euler.
bool averages_springs(const Settings& settings);

/// Makes contacts that are not springs rigid, but for a softness that is small beside the mobility
/// of each row: C/dt^2 would let bodies sink and rebound, the more the shorter the sub-step.
/// @param share of the mobility [-]
void stiffen_contacts(const Substep& sub, double share, std::span<Block> rows);

/// Sets bias and softness of all compliant rows, after the drift correction. Block::elastic is the
/// elastic part of phi; the rest is drift.
void set_springs(const Substep& sub, const State& state);

/// Stores the elastic part of phi after the sub-step, from its law and the computed force
/// Block::lambda, in Block::elastic.
void store_elastic(Block& joint);

}  // namespace substep
