#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/constraints/turning_stiffness.hpp"
#include "core/solver/bpp.hpp"
#include "core/solver/cost_model.hpp"
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
  void reserve(std::size_t bodies, std::size_t blocks, bool loops) override;
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

  // The linear system of a step. Its rows are redundant only to the order of the sub-step: the
  // choice of impulses acts on the velocities, and must be the one of the solve for these.
  Bpp linear_{SaddleLdlt::Redundant::kImpulsesOfCycles};
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

namespace {

constexpr double kConverged = 1e-9;  // largest change of a speed in a step, of the fastest body's

/// Of the mean, average acceleration.
constexpr PoseWeights kMean{0.25, 0.5, 0.25, 0.0};

/// The resisting diagonal of -K about a body's principal axes, the columns of R_WB.
Mat3 resisting_diagonal(const Mat3& K, const Mat3& R_WB) {
  const Vec3 k = -R_WB.cwiseProduct(K * R_WB).colwise().sum().transpose();
  return R_WB * k.cwiseMax(0.0).asDiagonal() * R_WB.transpose();
}

/// Copies a block for a step. For known point rows only what changes in a sub-step: move_rows() and
/// the steps write the rest.
void copy_start(const Block& start, Block& row) {
  if (!start.has_point_rows || !row.has_point_rows || row.id != start.id || row.a != start.a ||
      row.b != start.b) {
    row = start;
    return;
  }
  for (int i = 0; i < kMaxRows; ++i) {
    row.C[i] = start.C[i];
    row.softness[i] = start.softness[i];
    row.impulse[i] = start.impulse[i];
  }
}

}  // namespace

void Newton::reserve(std::size_t bodies, std::size_t blocks, bool loops) {
  linear_.reserve(bodies, blocks, loops);
  rows_.reserve(blocks);
  back_.reserve(blocks);
  K_.reserve(bodies);
  motions_.reserve(bodies);
  numerov_.reserve(bodies);
}

void Newton::read_rows(const System& system, Forces forces) {
  rows_.resize(system.blocks.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) copy_start(system.blocks[i], rows_[i]);
  if (forces == Forces::kEnd) return;
  if (back_.size() < rows_.size()) back_.resize(rows_.size());
  if (forces == Forces::kNumerov) {
    for (std::size_t i = 0; i < rows_.size(); ++i) copy_start(system.blocks[i], back_[i]);
    return numerov_.begin(system, u_star_);
  }
  motions_.set(system.u_before, -system.dt);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Block& start = system.blocks[i];
    move_rows(start, motions_.of(start.a), motions_.of(start.b), back_[i]);
  }
}

// Linearised about the iterate u:
//   phi + dt J (u+ - u) + dt softness * impulse = 0
// so the linear system has the bias phi/dt - J u. phi is evaluated at the end, with J' in place of
// its J.
void Newton::relinearise(const System& system, Forces forces) {
  aim_ = u_star_;
  if (forces == Forces::kNumerov) {
    move_along_courses(system);
  } else {
    motions_.set(system.u, system.dt);
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Block& start = system.blocks[i];
    Block& block = rows_[i];
    if (forces == Forces::kNumerov) {
      const PoseWeights w = numerov_.weights_of(system, start);
      if (!start.is_bounded()) add_gained(system, i, w);
      average(start, back_[i], w, block);
    } else {
      move_rows(start, motions_.of(start.a), motions_.of(start.b), block);
      if (forces == Forces::kMean) average(start, back_[i], kMean, block);
    }
    double speed[kMaxRows];
    row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      block.bias[row] = start.bias[row] + block.phi[row] / system.dt - speed[row];
    }
  }
}

void Newton::move_along_courses(const System& system) {
  numerov_.find_turns(system);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Block& start = system.blocks[i];
    move_rows(start, numerov_.ahead().of(start.a), numerov_.ahead().of(start.b), rows_[i]);
    move_rows(start, numerov_.behind().of(start.a), numerov_.behind().of(start.b), back_[i]);
    numerov_.add_forces(system, start, back_[i], rows_[i]);
  }
}

// J' = w- J- + w0 J + w+ J+.
void Newton::average(const Block& start, const Block& back, const PoseWeights& w, Block& end) {
  const auto averaged = [&](int row, int j, auto J) {
    (end.*J)[row][j] =
        (w.behind * (back.*J)[row][j] + w.ahead * (end.*J)[row][j]) + w.here * (start.*J)[row][j];
  };
  const int first = start.has_point_rows ? 3 : 0;  // rows 0 to 2 of a pin are linear in its arms
  for (int row = first; row < start.rows; ++row) {
    for (int j = first; j < 6; ++j) {
      averaged(row, j, &Block::J_a);
      if (!start.has_point_rows) averaged(row, j, &Block::J_b);
    }
  }
  end.r_a = (w.behind * back.r_a + w.ahead * end.r_a) + w.here * start.r_a;
  end.r_b = (w.behind * back.r_b + w.ahead * end.r_b) + w.here * start.r_b;
}

// In Numerov's method the other poses have their own impulses. With those behind,
// p - b p', and ahead, p + dt p', the sum is J'^T p + (w+ dt J+ - w- b J-)^T p'. The second-order
// part of p acts along J and only changes the multiplier.
void Newton::add_gained(const System& system, std::size_t index, const PoseWeights& w) {
  const Block& start = system.blocks[index];
  if (!start.seeded) return;
  const double time = longest_of(start, system.force_time);
  double ahead[kMaxRows];
  double behind[kMaxRows];
  for (int row = 0; row < start.rows; ++row) {
    ahead[row] = time * w.ahead * system.dt * start.rate[row];
    behind[row] = -time * w.behind * w.reach * start.rate[row];
  }
  apply_impulse(rows_[index], ahead, system.inverse_mass, aim_);
  apply_impulse(back_[index], behind, system.inverse_mass, aim_);
}

// The forces rotate with q+, so the Hessian is -w dt K(impulse); D, the resisting part of its
// diagonal, is added to M. With A = (E + M^-1 D)^-1, Mt^-1 = A M^-1 and Mt^-1 M = A:
//   Mt (u+ - u) = -M (u - u*) + J'^T impulse
// is the linear system that starts from u - A (u - u*).
void Newton::stiffen(const System& system, Forces forces) {
  K_.assign(system.u.size(), Mat3::Zero());
  for (Block& block : rows_) {
    const double w = forces == Forces::kEnd ? 1.0
                     : forces == Forces::kMean
                         ? kMean.ahead
                         : std::max(0.0, numerov_.weights_of(system, block).ahead);
    // K is linear in the forces: dt^2 K(impulse/dt) = dt K(impulse).
    for (int row = 0; row < block.rows; ++row) {
      block.lambda[row] = w * system.dt * block.impulse[row];
    }
    add_turning_stiffness(block, K_);
  }
  for (std::size_t i = 0; i < u_.size(); ++i) {
    const Mat3 D = resisting_diagonal(K_[i], system.R_WB[i]);
    const Mat3& W = system.inverse_mass[i].angular;
    const Mat3 A = (Mat3::Identity() + W * D).inverse();
    const Mat3 Mt = A * W;
    inverse_mass_[i] = {system.inverse_mass[i].linear, 0.5 * (Mt + Mt.transpose())};
    u_[i].head<3>() = aim_[i].head<3>();
    u_[i].tail<3>() = system.u[i].tail<3>() - A * (system.u[i].tail<3>() - aim_[i].tail<3>());
  }
}

double Newton::take(const System& system) {
  double change = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < u_.size(); ++i) {
    const double gyration = gyration_squared(system.inverse_mass[i]);
    change = std::max(change, speed_squared(u_[i] - system.u[i], gyration));
    largest = std::max(largest, speed_squared(u_[i], gyration));
    largest = std::max(largest, speed_squared(u_star_[i], gyration));
    system.u[i] = u_[i];
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Block& block = system.blocks[i];
    std::copy(rows_[i].impulse, rows_[i].impulse + block.rows, block.impulse);
    std::copy(rows_[i].active_set, rows_[i].active_set + block.rows, block.active_set);
  }
  return change == 0.0 ? 0.0 : std::sqrt(change / largest);
}

SolveReport Newton::find_velocities(const System& system, const Settings& settings) {
  u_star_.assign(system.u.begin(), system.u.end());
  Settings linear_settings = settings;
  const bool isotropic = settings.friction_cone == FrictionCone::kCone;
  if (isotropic) {
    align_tangents(system);
    linear_settings.friction_cone = FrictionCone::kBox;  // of these tangents, in every step
  }
  u_.resize(u_star_.size());
  inverse_mass_.resize(u_star_.size());
  read_rows(system, settings.forces);
  // Initial guess: velocities and forces of the last sub-step, or extrapolated at constant rates.
  copy(system.u_guess.empty() ? system.u_before : system.u_guess, system.u);
  if (settings.forces == Forces::kNumerov) move_along_courses(system);  // by no torques

  SolveReport report;
  for (double change = 1.0; change > kConverged;) {  // false for NaN
    if (report.iterations == settings.iterations) {
      report.status = SolveStatus::kUnsolved;
      break;
    }
    relinearise(system, settings.forces);
    for (Block& block : rows_) {
      if (isotropic && block.is_contact() && block.rows == 3) soften_across(block);
    }
    stiffen(system, settings.forces);
    System linear{rows_, inverse_mass_, u_, system.u_before, system.dt};
    linear.limits = {system.limits.memory, system.limits.work - static_cast<double>(report.flops)};
    SolveReport step = linear_.solve(linear, linear_settings);
    if (step.status == SolveStatus::kOverLimits) {
      if (step.work_needed > 0.0) step.work_needed += static_cast<double>(report.flops);
      return step;
    }
    change = take(system);
    ++report.iterations;
    report.status = step.status;
    report.pivots += step.pivots;
    report.passes += step.passes;
    report.factorisations += step.factorisations;
    report.flops += step.flops + relinearise_flops(rows_, std::ssize(u_), settings.forces);
  }
  if (settings.forces == Forces::kNumerov) numerov_.find_turns(system);
  return report;
}

std::unique_ptr<Solver> make_newton() { return std::make_unique<Newton>(); }

}  // namespace substep
