#include "core/stepping/drift.hpp"

#include <algorithm>
#include <cmath>

#include "core/constraints/contact.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/forces/applied_forces.hpp"
#include "core/stepping/compliance.hpp"

namespace substep {

double drift_rate(Drift law, double tau, double dt) {
  return law == Drift::kSoft && dt < tau ? dt / (tau * tau) : 1.0 / dt;
}

void set_drift_bias(std::span<Block> blocks, Drift law, double tau, double dt, double planned_dt) {
  const double full = 1.0 / dt;
  const double rate = drift_rate(law, tau, dt);
  const double of_joints = rate == full ? 1.0 / planned_dt : rate;
  for (Block& block : blocks) {  // all kMaxRows: a compile-time loop bound
    const double of_block = block.is_unilateral() ? rate : of_joints;
    for (int row = 0; row < kMaxRows; ++row) block.bias[row] = block.phi[row] * of_block;
    if (!block.is_unilateral()) continue;
    if (block.phi[0] > 0.0) {
      block.bias[0] = block.phi[0] * full;
    } else if (rate < full) {
      block.bias[0] += block.elastic[0] * (full - rate);
    }
  }
}

namespace {

const Vec6 kRest = Vec6::Zero();

}  // namespace

void curvature_of(const Block& block, std::span<const Vec6> u, double* curvature) {
  const auto velocity = [&](int body) -> const Vec6& { return body < 0 ? kRest : u[index(body)]; };
  with_joint_rows(block.kind, [&](auto joint) {
    joint.curvature(block, velocity(block.a), velocity(block.b), curvature);
  });
}

void add_curvature_bias(std::span<Block> blocks, std::span<const Vec6> u, double dt) {
  double curvature[kMaxRows] = {};
  for (Block& block : blocks) {
    if (block.is_bounded()) continue;
    curvature_of(block, u, curvature);
    for (int row = 0; row < block.rows; ++row) block.bias[row] += 0.5 * dt * curvature[row];
  }
}

void set_acceleration_rows(std::span<Block> joints, std::span<const Vec6> u,
                           std::span<const InverseMass> inverse_mass, double dt,
                           double regularisation) {
  double curvature[kMaxRows] = {};
  for (Block& block : joints) {
    curvature_of(block, u, curvature);
    const auto is_spring = [&](int first, int end) {
      return first < end && block.C[first] > 0.0 &&
             spring_kappa(dt * dt, inverse_mass, block, first, end) < kResolved;
    };
    const bool springs[2] = {is_spring(0, block.position_rows),
                             is_spring(block.position_rows, block.rows)};
    for (int row = 0; row < block.rows; ++row) {
      block.bias[row] = curvature[row];
      block.softness[row] = regularisation;
      block.impulse[row] = block.given[row] = 0.0;
      if (springs[row < block.position_rows ? 0 : 1])
        give_force(inverse_mass, block, row, -block.phi[row] / block.C[row]);
    }
  }
}

namespace {

bool is_angle(const Block& row) { return row.is_coordinate() && row.position_rows == 0; }

}  // namespace

double speeds_of(const Block& row, std::span<const Vec6> u) {
  double speed = 0.0;
  for (const int body : {row.a, row.b}) {
    if (body < 0) continue;
    const Vec6& of_body = u[index(body)];
    speed += is_angle(row) ? of_body.tail<3>().norm() : of_body.head<3>().norm();
  }
  return speed;
}

namespace {

/// Velocities that the applied forces give to a body in a second, world [m/s, rad/s].
Vec6 applied_acceleration(const Substep& sub, std::size_t body) {
  Vec6 a = Vec6::Zero();
  for_each_force(sub.scene->effects, [&](auto force) {
    force.accelerate(*sub.scene, sub.scene->bodies[body], sub.inertia_inverse[body], sub.R_WB[body],
                     1.0, a);
  });
  return a;
}

// Of a body that rests on a limit. A force m g turns a body of the radius of gyration k about the
// axis, which hangs on an arm d, by
//   g d/(k^2 + d^2) <= g/(2 k).
// In a linkage whose bodies rotate, angular accelerations are of the size of omega^2. An armature
// adds to the mass along a travel and to the moment about an axis.
double largest_acceleration(const Substep& sub, const Block& row, bool of_a) {
  const std::size_t at = index(of_a ? row.a : row.b);
  const Body& body = sub.scene->bodies[at];
  const Vec6 applied = applied_acceleration(sub, at);
  MotorsOnBody motors = sub.motors_on.empty() ? MotorsOnBody{} : sub.motors_on[at];
  if (!sub.drives_on.empty()) {
    motors.force += sub.drives_on[at].force;
    motors.torque += sub.drives_on[at].torque;
  }
  const double turning = sub.u_before[at].tail<3>().squaredNorm();
  if (!is_angle(row)) {
    return applied.head<3>().norm() + motors.force / (body.mass + row.armature) +
           turning * (of_a ? row.r_a : row.r_b).norm();
  }
  const double pushed = applied.head<3>().norm() + motors.force / body.mass;
  const Vec3 axis = sub.R_WB[at].transpose() * row.axis;
  const double moment = axis.dot(body.inertia.cwiseProduct(axis)) + row.armature;
  return pushed / (2.0 * std::sqrt(moment / body.mass)) + motors.torque / moment +
         std::abs(applied.tail<3>().dot(row.axis)) + turning;
}

}  // namespace

double speed_by_forces(const Substep& sub, const Block& row) {
  if (row.is_contact()) return speeds_of(row, sub.gain);
  double acceleration = 0.0;
  for (const bool of_a : {true, false}) {
    if ((of_a ? row.a : row.b) >= 0) acceleration += largest_acceleration(sub, row, of_a);
  }
  return sub.planned_dt * acceleration;
}

void set_swept_bias(std::span<Block> blocks, std::span<const Vec6> gain,
                    std::span<const Vec6> shift, double dt, double planned_dt,
                    const std::function<bool(const Block&)>& is_deep) {
  constexpr double kYields = 0.1;  // at most this part of the speed by the forces
  constexpr double kRigid = 1e-4;  // but the softness not below this part of what it was
  constexpr double kKept = 0.5;  // of the force: less than all, so that forces in a jam are bounded
  constexpr double kStops = 0.2;  // of the overlap in a sub-step: the rest is kept by it
  for (Block& block : blocks) {
    if (!block.is_unilateral() || block.soft) continue;
    if (block.awaits) {
      block.bias[0] = kStaysOpen;
      continue;
    }
    // The motion is that of u + shift: a body that was struck moves for the rest of the sub-step.
    const double time = block.was_closed ? planned_dt : dt;
    block.bias[0] = std::max(std::max(block.phi[0], 0.0) / time + normal_speed(block, shift), 0.0);
    if (!block.was_closed || !block.is_contact()) continue;
    if (!(block.impulse[0] > 0.0)) continue;  // it has just been struck
    const double yields = block.softness[0] * block.impulse[0];
    const double share = std::clamp(kYields * speeds_of(block, gain) / yields, kRigid, 1.0);
    // Bodies sink until their overlap keeps the rest of the force; it never pushes them out. In a
    // deep overlap, which joints hold, the force would grow in each sub-step by what they leave of
    // the approach, without a bound.
    const double yielding = share * yields;
    const double by_overlap =
        is_deep(block) ? 0.0 : kStops * std::max(-block.phi[0], 0.0) / planned_dt;
    const double kept = std::min(kKept + by_overlap / yielding, 1.0);
    for (int row = 0; row < block.rows; ++row) {
      block.softness[row] *= share;
      block.bias[row] -= kept * block.softness[row] * block.impulse[row];
    }
  }
}

void set_probe_bias(std::span<Block> blocks, double dt) {
  for (Block& block : blocks) {
    for (int row = 0; row < block.rows; ++row) block.bias[row] = 0.0;
    if (block.is_unilateral() && block.phi[0] > 0.0) block.bias[0] = block.phi[0] / dt;
  }
}

}  // namespace substep
