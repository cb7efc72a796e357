#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "core/constraints/block.hpp"
#include "core/math/types.hpp"

namespace substep {

/// Mt^-1 of one body: Eq. 3 with Mt = M, M + dt B (Eq. 6), or any other symmetric choice per body.
struct InverseMass {
  double linear = 0.0;          // [1/kg]
  Mat3 angular = Mat3::Zero();  // world axes [1/(kg m^2)], symmetric
};

/// The square of a body's mean radius of gyration, 0 of a static one [m^2].
inline double gyration_squared(const InverseMass& of) {
  const double angular = of.angular.trace();
  return angular > 0.0 ? 3.0 * of.linear / angular : 0.0;
}

/// Square of a body's linear speed plus that of its angular speed times the radius of gyration
/// [m^2/s^2].
inline double speed_squared(const Vec6& u, double gyration_squared) {
  return u.head<3>().squaredNorm() + gyration_squared * u.tail<3>().squaredNorm();
}

/// Resource limits of a solve.
struct SolveLimits {
  double memory = std::numeric_limits<double>::infinity();  // for a factor [bytes]
  double work = std::numeric_limits<double>::infinity();    // [floating-point operations]
};

/// Motion of a body in a sub-step, for solvers that compute more than a velocity: the velocity for
/// integrate(), the acceleration at both ends and dt^2 times its second derivative. For bodies
/// whose angular momentum is carried (System::inertia), the torque replaces the angular
/// acceleration. [m/s, rad/s; m/s^2, rad/s^2 or N m]
struct BodyCourse {
  Vec6 move_by = Vec6::Zero();
  Vec6 start = Vec6::Zero();
  Vec6 end = Vec6::Zero();
  Vec6 bend = Vec6::Zero();
};

/// Input and output of a solver: find impulses and u+ = u* + Mt^-1 J^T impulse with
///   w = J u+ + softness * impulse + bias,
///   w = 0 where lo < impulse < hi,  w >= 0 at lo,  w <= 0 at hi.
/// Joint rows are unbounded; a contact's normal has [0, inf); its friction rows +-mu * normal
/// impulse.
struct System {
  std::span<Block> blocks;                    // impulse: seed in, solution out
  std::span<const InverseMass> inverse_mass;  // per body
  std::span<Vec6> u;                          // per body: u* in, u+ out [m/s, rad/s]

  // For solvers that use poses other than those at the start of the sub-step.
  std::span<const Vec6> u_before{};  // per body: of the last sub-step [m/s, rad/s]
  double dt = 0.0;                   // of this sub-step [s]
  std::span<const Mat3> R_WB{};      // per body: principal axes, columns in the world

  // The part of every softness that is not compliance; refinements remove it [1/kg].
  double regularisation = 0.0;

  // Per body: velocities before this sub-step, whose mean with u+ is the sliding of contacts [m/s,
  // rad/s]; empty in impacts.
  std::span<const Vec6> u_sliding{};

  // Per body: initial guess of Newton [m/s, rad/s]; if empty, u_before.
  std::span<const Vec6> u_guess{};

  // For Newton with forces numerov, per body: duration of forces [s]; principal moments of tumbling
  // bodies, whose u is I^-1 of the mean angular momentum over a sub-step, else 0 [kg m^2]; out: the
  // motion.
  std::span<const double> force_time{};
  std::span<const Vec3> inertia{};
  std::span<BodyCourse> courses{};

  SolveLimits limits{};

  bool contacts_yield = false;  // every contact has a softness, so that its impulse is unique

  double frame_share = 1.0;  // dt over the length of the frame, for small steps [-]
};

enum class SolveStatus : std::uint8_t {
  kSolved,     // BPP, Newton: complementary within tolerance. PGS, XPBD: all sweeps done
  kUnsettled,  // BPP: complementary, but friction bounds not converged; the next sub-step continues
  kUnsolved,   // BPP: pivot limit reached; Gauss-Seidel took over. Newton: not converged within its
               // steps
  kOverLimits,  // System::limits exceeded; impulses and velocities are invalid
};

struct SolveReport {
  SolveStatus status = SolveStatus::kSolved;
  int iterations = 0;            // sweeps of PGS and XPBD, steps of Newton
  std::int64_t row_updates = 0;  // PGS, XPBD
  int pivots = 0;                // BPP, also in Newton: changes of the active set
  int passes = 0;                // the same: refreshes of the friction bounds, the first included
  int factorisations = 0;        // BPP, also in Newton
  std::int64_t flops = 0;        // to form, factor and solve, and of row updates: cost_model.hpp
  double memory_needed = 0.0;    // for kOverLimits [bytes], 0 if the work was exceeded
  double work_needed = 0.0;      // for kOverLimits [operations], 0 if the memory was exceeded
};

/// J Mt^-1 J^T of one row through one of its bodies, 0 through a static one [1/kg or 1/(kg m^2)].
double mobility_on(const Block& block, int row, bool of_a,
                   std::span<const InverseMass> inverse_mass);
/// Through both.
inline double mobility_of(const Block& block, int row, std::span<const InverseMass> inverse_mass) {
  return mobility_on(block, row, true, inverse_mass) + mobility_on(block, row, false, inverse_mass);
}

/// The longer of the times of a block's bodies. @param times per body [s]
inline double longest_of(const Block& block, std::span<const double> times) {
  const double a = block.a < 0 ? 0.0 : times[index(block.a)];
  const double b = block.b < 0 ? 0.0 : times[index(block.b)];
  return std::max(a, b);
}

/// J u of all rows of a block: relative speeds.
/// @param speed out, one per row [m/s or rad/s]
void row_speeds(const Block& block, std::span<const Vec6> u, double* speed);

/// The same from the velocities of both sides; nullptr for a static one.
void row_speeds(const Block& block, const Vec6* a, const Vec6* b, double* speed);

/// Adds J^T x to the momenta of both sides; nullptr for a static one. @param x one per row
void push(const Block& block, const double* x, Vec6* a, Vec6* b);

/// u += Mt^-1 J^T impulse for all rows of a block.
void apply_impulse(const Block& block, const double* impulse,
                   std::span<const InverseMass> inverse_mass, std::span<Vec6> u);

/// The bound of a contact's row, given its normal impulse [N s].
double friction_bound(const Block& block, int row, double normal);

/// True for a contact with friction whose impulse, a seed or a solution, is within its bound.
bool sticks(const Block& contact);

/// Sets Block::share of the cone for a friction impulse; equal shares if it is zero.
void point_cone(Block& block, double along_t1, double along_t2);

/// Isotropic friction for solvers that bound each tangent: rotates the tangents of every contact,
/// with their rows, so that t1 points along its sliding, and prepares soften_across(). The sliding
/// is the mean of that of u_sliding and u of the system; where it is too slow to have a direction,
/// the tangents stay. Without u_sliding, as in impacts, it is that of u, and no row yields. Changes
/// bias and softness of row 2, once for each solve. Impulses are not rotated: those of the last
/// sub-step belong to its sliding, too.
void align_tangents(const System& system);

/// Row 2 of a contact that slides yields: the force points against the sliding, so that to first
/// order that across t1 is its share of the bound,
///   x_2 = -mu x_n s_2/|s|,   or   s_2 + |s|/(mu x_n) x_2 = 0,
/// with s the mean sliding of the sub-step. Otherwise bodies of unequal inertia, or with several
/// contacts, are kept from sliding across t1. A contact that sticks() does not yield.
/// x_n is the first normal impulse that is known, mostly that of the last sub-step: one that
/// followed the passes of a solve would let them swing. Adds to the softness of row 2.
/// @return true if it does
bool soften_across(Block& contact);

/// Largest violation of bounds [N s] and complementarity [m/s] of a solved system.
double lcp_residual(const System& system);

}  // namespace substep
