#pragma once

#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/solver/bpp.hpp"
#include "core/solver/numerov.hpp"
#include "core/solver/solver.hpp"

namespace substep {

/// Newton's method on the implicit sub-step (Macklin et al. 2019, "Non-smooth Newton methods for
/// deformable multi-body dynamics"): the errors vanish at the end of the sub-step, and impulses act
/// along the gradients J' of poses around it,
///   M (u+ - u*) = J'^T impulse,   phi(q+)/dt + softness * impulse = 0,
/// complementary for contacts. Settings::forces selects the poses, out of those before, at and
/// after q:
///   end      J' = J+, as in the paper cited. Stable for any step, but dissipative: implicit Euler.
///   mean     J' = (J- + 2 J + J+)/4. Time-reversible, hence undamped, and stable for any step on
///   the model of Eq. 5: average acceleration of Newmark's family.
///   numerov  J' = (J- + 10 J + J+)/12, after Numerov's q+ - 2 q + q- = dt^2 (a- + 10 a + a+)/12.
///            Fourth order on the model of Eq. 5, and stable while dt^2 k < 6 M. Forces at the
///            neighbouring poses follow from Block::rate; velocities are means over a sub-step, and
///            rotations follow from the torques at its ends (numerov.hpp). Rates and initial guess
///            are extrapolated from earlier sub-steps: two Newton steps suffice; with one the order
///            is 3 for tumbling bodies, and amplitudes near the limit grow slightly.
/// Stability: if q grows by the factor z per sub-step, the model of Eq. 5 with kappa = dt^2 k/M and
/// the share w of each neighbouring pose is
///   (1 + w kappa) (z^2 + 1) - (2 - (1 - 2 w) kappa) z = 0.
/// The product of its roots is 1, so both lie on the unit circle while (1 - 4 w) kappa <= 4: for
/// any kappa with w = 1/4, up to 6 with 1/12. With the force at the end alone it is
/// (1 + kappa) z^2 - 2 z + 1 = 0, and |z|^2 = 1/(1 + kappa) is below 1 for any kappa.
/// Each step adds to M the part of the constraint Hessian that resists rotation about a body's
/// principal axes, a diagonal as in the paper cited: two to five steps suffice, and without it
/// heavily loaded joints do not converge. At most Settings::iterations steps, starting from the
/// forces of the last sub-step and from System::u_guess or its velocities.
class Newton final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  /// Fills rows_, and back_ if forces depend on more poses than the end's.
  void read_rows(const System& system, Forces forces);
  void relinearise(const System& system, Forces forces);
  void move_along_courses(const System& system);
  static void average(const Block& start, const Block& back, const PoseWeights& w, Block& end);
  void add_gained(const System& system, std::size_t block, const PoseWeights& w);
  void stiffen(const System& system, Forces forces);
  /// Applies the solution of the linear system. @return largest relative change of a velocity
  double take(const System& system);

  // The linear system of a step.
  Bpp linear_;
  std::vector<Block> rows_;  // the blocks at the end of the sub-step
  std::vector<InverseMass> inverse_mass_;
  std::vector<Vec6> u_;

  std::vector<Vec6> u_star_;  // per body: before any impulse
  std::vector<Vec6> aim_;    // per body: u_star_ plus the terms independent of this step's impulses
  std::vector<Block> back_;  // arms and J at the poses of the last sub-step, nothing else
  Motions motions_;
  std::vector<Mat3> K_;  // per body: d torque/d rotation, times dt^2
  NumerovCourses numerov_;
};

}  // namespace substep
