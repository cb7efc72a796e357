#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

// A compliant joint or contact is a spring: its force is -phi/C at the poses that the integrator
// takes forces from, not an error that is taken back. Of the poses before, at and after the
// sub-step,
//   C lambda = -(w+ phi+ + w0 phi + w- phi-),   w+ + w0 + w- = 1,
// so that at rest it gives way by C lambda whatever the weights, dt and N. With phi+ = phi + dt J
// u+, phi- = phi - dt- J u- and the impulse p = t lambda, t the time that forces act for, a row is
//   J u+ + C/(w+ dt t) p = -(phi - w- dt- J u-)/(w+ dt).
// On one degree of freedom with kappa = dt t/(C m) the recurrence is
//   (1 + w+ kappa) phi+ - (2 - w0 kappa) phi + (1 + w- kappa) phi- = 0,
// stable while w+ >= w- and 2 (w+ + w-) >= 1 - 4/kappa, and it loses kappa (w+ - w-)/2 of its
// amplitude a sub-step. The weights are therefore
//   Euler, Newton's forces at the end   w+ = 1: implicit Euler, the paper's;
//   leapfrog, Newton's Numerov          w+ = w- = 1/12, Numerov's: of fourth order for one spring;
//   Newton's forces at the mean         w+ = w- = 1/4, average acceleration;
//   Störmer                             w+ = w- = 0: the force of the poses, given to the rows;
// and where a spring is too stiff to be resolved, they go over into implicit Euler, by
// sigma = kappa^2/(kappa^2 + 4): w+ - w- = sigma, which changes a spring that is resolved by the
// fourth order of dt.

/// Weights of the poses ahead and behind, w+ and w-.
struct SpringWeights {
  double ahead = 1.0;
  double behind = 0.0;
};
SpringWeights spring_weights(const Settings& settings, double kappa);

/// Whether compliant rows are other than implicit Euler's.
bool averages_springs(const Settings& settings);

/// What a sub-step knows besides its rows.
struct SubstepTimes {
  double dt = 0.0;           // [s]
  double dt_previous = 0.0;  // of the sub-step before [s]
  double force_time = 0.0;   // t, that forces act for [s]
};

/// Softness of a row that is given its impulse: past all that J u could add to it [1/kg].
inline constexpr double kGivenForce = 1e12;
/// A row whose impulse is known before the solve, Block::given, which adds nothing to it. As
/// softness and bias alone it would be a small difference of large numbers. @param impulse [N s, N
/// m s]
void give_force(Block& joint, int row, double impulse);

/// kappa of the rows that share a compliance, by the softest way that they can move.
double spring_kappa(const SubstepTimes& times, std::span<const InverseMass> inverse_mass,
                    const Block& joint, int first, int end);
inline constexpr double kResolved = 0.25;  ///< kappa up to which Störmer's springs are given forces

/// Bias and softness of the compliant rows of a joint. Of phi, Block::elastic is the spring's own;
/// the rest is drift.
/// @param drift_rate at which drift is taken back [1/s]  @param inverse_mass, u_before per body of
/// the scene  @param regularisation that joins C in the softness [1/kg]
void set_springs(const Settings& settings, const SubstepTimes& times, double drift_rate,
                 std::span<const InverseMass> inverse_mass, std::span<const Vec6> u_before,
                 double regularisation, Block& joint);

/// The least compliance of a contact that is meant as a spring. Stiffer ones stand for rigid
/// bodies, which land without a rebound: their implicit Euler takes the energy of the impact [m/N].
inline constexpr double kSoftContact = 1e-6;
/// kappa up to which a contact's spring is averaged: its weights are implicit Euler's to 1e-3
/// there.
inline constexpr double kResolvedContact = 100.0;
/// Bias and softness of the normal of a compliant contact under the full drift law, where all of
/// phi is the spring's own: the mean force of the three poses, and never a pull.
void set_contact_spring(const Settings& settings, const SubstepTimes& times,
                        std::span<const InverseMass> inverse_mass, std::span<const Vec6> u_before,
                        double regularisation, Block& contact);

/// What is the spring's own of phi after the sub-step, by its law and the force found: into
/// Block::elastic. @param lambda per row [N, N m]
void store_elastic(const double* lambda, Block& joint);

}  // namespace substep
