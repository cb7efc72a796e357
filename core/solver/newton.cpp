#include "core/solver/newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/constraints/moved_rows.hpp"
#include "core/constraints/stiffness_flops.hpp"
#include "core/constraints/turning_stiffness.hpp"
#include "core/math/flops.hpp"

namespace substep {

namespace {

constexpr double kConverged = 1e-9;  // largest change of a velocity in a step, relative

/// The share of each of the two neighbouring poses, and of q+ in the Hessian.
double weight_of(Forces forces) {
  switch (forces) {
    case Forces::kEnd:
      return 1.0;
    case Forces::kMean:
      return 1.0 / 4.0;
    case Forces::kNumerov:
      return 1.0 / 12.0;
  }
  return 1.0;
}

/// Of a step but for the linear system's own: rows at other poses, their averages, and the Hessian.
std::int64_t relinearise_flops(std::span<const Block> blocks, std::size_t bodies, Forces forces) {
  constexpr std::int64_t kBody = 2 * product_flops(3, 3, 3) + 30 +  // D
                                 2 * product_flops(3, 3, 3) + 40 +  // Mt^-1
                                 2 * product_flops(3, 3, 1) + 30;   // u, its change
  std::int64_t flops = kBody * static_cast<std::int64_t>(bodies);
  for (const Block& block : blocks) {
    const std::int64_t sides = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
    flops += move_flops(block, block.rows) + product_flops(block.rows, 6, sides) + 4 * block.rows +
             turning_stiffness_flops(block);
    if (forces == Forces::kEnd) continue;
    const std::int64_t averaged = block.rows * (block.pinned ? 3 : 6) + 3;
    flops += 4 * averaged * sides;
    if (forces == Forces::kNumerov) flops += 20 * block.rows * sides;
  }
  return flops;
}

/// What of -K resists a turn about each of a body's principal axes, its columns those of R_WB.
Mat3 resisting_diagonal(const Mat3& K, const Mat3& R_WB) {
  const Vec3 k = -R_WB.cwiseProduct(K * R_WB).colwise().sum().transpose();
  return R_WB * k.cwiseMax(0.0).asDiagonal() * R_WB.transpose();
}

/// A block as a step finds it. Of a joint that it knows only what a sub-step changes: move_rows()
/// and the steps write the rest.
void copy_start(const Block& start, Block& row) {
  if (!start.pinned || !row.pinned || row.id != start.id || row.a != start.a || row.b != start.b) {
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

void Newton::reserve(std::size_t bodies, std::size_t blocks) {
  linear_.reserve(bodies, blocks);
  rows_.reserve(blocks);
  back_.reserve(blocks);
  K_.reserve(bodies);
  motions_.reserve(bodies + 1);
}

void Newton::move_bodies(std::span<const Vec6> u, double dt) {
  motions_.clear();
  for (const Vec6& v : u) motions_.push_back(motion(v, dt));
  motions_.emplace_back();
}

const Motion& Newton::motion_of(int body) const {
  return body < 0 ? motions_.back() : motions_[static_cast<std::size_t>(body)];
}

void Newton::read_rows(const System& system, Forces forces) {
  rows_.resize(system.blocks.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) copy_start(system.blocks[i], rows_[i]);
  if (forces == Forces::kEnd) return;
  if (back_.size() < rows_.size()) back_.resize(rows_.size());
  move_bodies(system.u_before, -system.dt);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Block& start = system.blocks[i];
    move_rows(start, motion_of(start.a), motion_of(start.b), back_[i]);
  }
}

// Linearised about the iterate u:
//   phi + dt J (u+ - u) + dt softness * impulse = 0
// so the linear system has the bias phi/dt - J u. phi is that of the end; J' stands for its J.
void Newton::relinearise(const System& system, Forces forces) {
  aim_ = u_star_;
  move_bodies(system.u, system.dt);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Block& start = system.blocks[i];
    Block& block = rows_[i];
    move_rows(start, motion_of(start.a), motion_of(start.b), block);
    if (forces != Forces::kEnd) {
      average(system, i, weight_of(forces), forces == Forces::kNumerov);
    }
    double speed[kMaxRows];
    row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      block.bias[row] = start.bias[row] + block.phi[row] / system.dt - speed[row];
    }
  }
  if (forces == Forces::kNumerov) straighten_turns(system);
}

// J' = w J- + (1 - 2 w) J + w J+.
void Newton::average(const System& system, std::size_t index, double w, bool numerov) {
  const Block& start = system.blocks[index];
  Block& end = rows_[index];
  const Block& back = back_[index];
  if (numerov && start.pinned) add_gained(system, index, w);
  const auto averaged = [&](int row, int j, auto J) {
    (end.*J)[row][j] =
        w * ((back.*J)[row][j] + (end.*J)[row][j]) + (1.0 - 2.0 * w) * (start.*J)[row][j];
  };
  const int first = start.pinned ? 3 : 0;  // rows 0 to 2 of a pin are linear in its arms
  for (int row = first; row < start.rows; ++row) {
    for (int j = first; j < 6; ++j) {
      averaged(row, j, &Block::J_a);
      if (!start.pinned) averaged(row, j, &Block::J_b);
    }
  }
  end.r_a = w * (back.r_a + end.r_a) + (1.0 - 2.0 * w) * start.r_a;
  end.r_b = w * (back.r_b + end.r_b) + (1.0 - 2.0 * w) * start.r_b;
}

// Numerov's method has the forces of the neighbours with their own impulses, (J- p- + 10 J p +
// J+ p+)/12. With p-+ = p -+ g, g what they gain in a sub-step, that is J'^T p + (J+ - J-)^T g/12;
// what is bent about p acts along J and only changes the multiplier. g is half of what lies between
// the neighbours: p - p- would be half a sub-step late, and the whole of third order. J+ - J- of a
// pin has no linear part.
void Newton::add_gained(const System& system, std::size_t index, double w) {
  const Block& start = system.blocks[index];
  const Block& end = rows_[index];
  const Block& back = back_[index];
  double gain[kMaxRows] = {};
  for (int row = 0; row < start.rows; ++row) {
    gain[row] = start.seeded ? w * start.gain[row] : 0.0;
  }
  const auto turn = [&](int body, double sign, const Vec3& arm_gained) {
    Vec3 torque = arm_gained.cross(Vec3(gain[0], gain[1], gain[2]));
    for (int row = 3; row < start.rows; ++row) {
      for (int j = 0; j < 3; ++j) {
        torque[j] += (end.J_a[row][3 + j] - back.J_a[row][3 + j]) * gain[row];
      }
    }
    const auto i = static_cast<std::size_t>(body);
    aim_[i].tail<3>() += sign * (system.inverse_mass[i].angular * torque);
  };
  if (start.a >= 0) turn(start.a, 1.0, end.r_a - back.r_a);
  if (start.b >= 0) turn(start.b, -1.0, end.r_b - back.r_b);
}

// u turns a body by the angle 2 atan(dt |omega|/2), so omega is longer than the turn by dt by
// dt^2 |omega|^2/12, and its change by the derivative of that.
void Newton::straighten_turns(const System& system) {
  const double c = system.dt * system.dt / 12.0;
  for (std::size_t i = 0; i < aim_.size(); ++i) {
    const Vec3 w = 0.5 * (system.u[i] + system.u_before[i]).tail<3>();
    const Vec3 change = (system.u[i] - system.u_before[i]).tail<3>();
    aim_[i].tail<3>() += c * (w.squaredNorm() * change + 2.0 * w.dot(change) * w);
  }
}

// The forces turn with q+, so the Hessian is -w dt K(impulse), and D, what of its diagonal resists,
// joins M. With A = (E + M^-1 D)^-1, Mt^-1 = A M^-1 and Mt^-1 M = A:
//   Mt (u+ - u) = -M (u - u*) + J'^T impulse
// is the linear system that starts from u - A (u - u*).
void Newton::stiffen(const System& system, Forces forces) {
  const double w = weight_of(forces);
  K_.assign(system.u.size(), Mat3::Zero());
  for (Block& block : rows_) {
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
  for (std::size_t i = 0; i < u_.size(); ++i) {
    change = std::max(change, (u_[i] - system.u[i]).norm() / (1.0 + u_[i].norm()));
    system.u[i] = u_[i];
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Block& block = system.blocks[i];
    std::copy(rows_[i].impulse, rows_[i].impulse + block.rows, block.impulse);
    std::copy(rows_[i].tight, rows_[i].tight + block.rows, block.tight);
  }
  return change;
}

SolveReport Newton::find_velocities(const System& system, const Settings& settings) {
  u_star_.assign(system.u.begin(), system.u.end());
  u_.resize(u_star_.size());
  inverse_mass_.resize(u_star_.size());
  read_rows(system, settings.forces);
  // The guess: nothing changes, or what changes goes on as it did.
  copy(system.u_guess.empty() ? system.u_before : system.u_guess, system.u);

  SolveReport report;
  for (double change = 1.0; change > kConverged;) {  // false for what is not a number
    if (report.iterations == settings.iterations) {
      report.status = SolveStatus::kUnsolved;
      break;
    }
    relinearise(system, settings.forces);
    stiffen(system, settings.forces);
    System linear{rows_, inverse_mass_, u_, system.u_before, system.dt};
    linear.limits = {system.limits.memory, system.limits.work - static_cast<double>(report.flops)};
    const SolveReport step = linear_.solve(linear, settings);
    if (step.status == SolveStatus::kOverLimits) {
      report.status = step.status;
      report.memory_needed = step.memory_needed;
      report.work_needed =
          step.work_needed > 0.0 ? step.work_needed + static_cast<double>(report.flops) : 0.0;
      return report;
    }
    change = take(system);
    ++report.iterations;
    report.status = step.status;
    report.pivots += step.pivots;
    report.passes += step.passes;
    report.factorisations += step.factorisations;
    report.flops += step.flops + relinearise_flops(rows_, u_.size(), settings.forces);
  }
  return report;
}

}  // namespace substep
