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
/// complementary for contacts. Settings::forces says which, of those before, at and after q:
///   end      J' = J+, the source's. Stable for any step, and a damper: implicit Euler.
///   mean     J' = (J- + 2 J + J+)/4. The same forwards and backwards in time, so that nothing is
///            damped, and on the model of Eq. 5 stable for any step all the same: the average
///            acceleration of Newmark's family.
///   numerov  J' = (J- + 10 J + J+)/12, after Numerov's q+ - 2 q + q- = dt^2 (a- + 10 a + a+)/12.
///            On the model of Eq. 5 the error is of fourth order, and stable while dt^2 k < 6 M.
///            The forces of the neighbours differ from this one by how they change, Block::rate;
///            velocities are means over a sub-step, and turns follow from the torques at its ends
///            (numerov.hpp). Rates and first guess are extrapolated from the sub-steps before: two
///            steps do; one is of third order where bodies tumble, and lets what is near the limit
///            swing a little wider.
/// How far they are stable: where q grows by the factor z in a sub-step, the model of Eq. 5 with
/// kappa = dt^2 k/M and the share w of each neighbouring pose is
///   (1 + w kappa) (z^2 + 1) - (2 - (1 - 2 w) kappa) z = 0.
/// The product of its roots is 1, so both lie on the unit circle while (1 - 4 w) kappa <= 4: for
/// any kappa with w = 1/4, up to 6 with 1/12. With the end's force alone it is
/// (1 + kappa) z^2 - 2 z + 1 = 0, and |z|^2 = 1/(1 + kappa) is below 1 for any kappa.
/// What of the constraints' Hessian resists turns about a body's principal axes, a diagonal as the
/// source has it, joins M in each step: two to five steps do, and without it nothing that hangs
/// under a heavy load converges. At most Settings::iterations steps, from System::u_guess or the
/// velocities, and the forces, of the last sub-step.
class Newton final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  void move_bodies(std::span<const Vec6> u, double dt);
  [[nodiscard]] const Motion& motion_of(int body) const;
  /// Into rows_, and into back_ where the forces are those of more poses than the end's.
  void read_rows(const System& system, Forces forces);
  void relinearise(const System& system, Forces forces);
  void move_along_courses(const System& system);
  static void average(const Block& start, const Block& back, const PoseWeights& w, Block& end);
  void add_gained(const System& system, std::size_t block, const PoseWeights& w);
  void stiffen(const System& system, Forces forces);
  /// Takes the solution of the linear system. @return the largest change of a velocity, relative
  double take(const System& system);

  // The linear system of a step.
  Bpp linear_;
  std::vector<Block> rows_;  // the blocks at the end of the sub-step
  std::vector<InverseMass> inverse_mass_;
  std::vector<Vec6> u_;

  std::vector<Vec6> u_star_;  // per body: before any impulse
  std::vector<Vec6> aim_;     // per body: u_star_ with what does not depend on this step's impulses
  std::vector<Block> back_;   // arms and J at the poses of the last sub-step, nothing else
  std::vector<Motion> motions_;  // per body, and of what stands still at the end
  std::vector<Mat3> K_;          // per body: what its turning does to its torque, times dt^2
  NumerovCourses numerov_;
};

}  // namespace substep
