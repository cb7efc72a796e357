#include "core/stepping/euler.hpp"

#include <Eigen/LU>

#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/math/gyroscopic.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/integrate.hpp"

namespace substep {

namespace {

// How an impact acts on a body.
constexpr std::uint8_t kHit = 1;
constexpr std::uint8_t kArrives = 2;  // it still moves towards what it meets

/// True if a body that was hit may rest on what hit it: it is less than kFast times as fast as the
/// forces of a sub-step make it. For a faster one that does rest across them, half of the gain is
/// an error of at most (1/20)^2 of its kinetic energy.
bool rests(std::uint8_t hit, const Vec6& u, const Vec6& gain) {
  constexpr double kFast = 10.0;
  return hit == kHit && u.head<3>().norm() < kFast * gain.head<3>().norm();
}

}  // namespace

Euler::Euler(const Scene& scene) {
  hit_.resize(scene.bodies.size());
  bent_push_.resize(scene.bodies.size());
  if (scene.effects.gyroscopic) gyroscopic_.emplace();
}

bool Euler::strikes_spin(const Substep& sub, std::size_t body) const {
  return gyroscopic_ && gyroscopic_->predicts() && tumbles(sub, body);
}

void Euler::begin_solve(const Substep& sub) {
  if (gyroscopic_ && gyroscopic_->predicts()) gyroscopic_->begin_solve(sub);
}

Vec3 Euler::spin_at_start(const Substep& sub, std::size_t body) const {
  return strikes_spin(sub, body) ? gyroscopic_->spin_at_start(sub, body)
                                 : TimeIntegrator::spin_at_start(sub, body);
}

Vec3 Euler::strike(const Substep& sub, std::size_t body, const Vec3& spin_at_start) {
  return strikes_spin(sub, body) ? gyroscopic_->strike(sub, body, spin_at_start) : spin_at_start;
}

void Euler::keep_strikes(const Substep& sub) {
  if (gyroscopic_ && gyroscopic_->predicts()) gyroscopic_->keep_strikes(sub);
}

std::int64_t Euler::aim(const Substep& sub, State& /*state*/) {
  if (gyroscopic_) gyroscopic_->bend_rows(sub);
  return 0;
}

void Euler::predict_velocities(const Substep& sub, const State& state, std::span<Vec6> w) const {
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    w[i] = state.u[i];
    if (gyroscopic_) w[i].tail<3>() = gyroscopic_->settled(sub, i, w[i].tail<3>());
  }
}

void Euler::move_poses(const Substep& sub, State& state) {
  state.acceleration.clear();  // of another method, outdated
  state.acceleration_change.clear();
  integrate(sub, state.u, turn_spin, state);
}

// Applies the forces of the sub-step for half of its length; of those on bodies that were hit,
// none, or the applied ones if a body cannot be at rest. Joint forces are applied along the rows at
// the new poses, where they do no work and conserve the angular momentum about a fixed anchor.
void Euler::synchronise(const Substep& sub, State& state) {
  // A solver that holds constraints at the end applies forces along rows at later poses.
  const bool turns_forces = sub.scene->effects.joints && !entry_of(sub.settings.solver).at_end;
  if (turns_forces) turn_joint_forces(sub, state);
  find_hit(sub);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    const double share = share_ahead(state.dt_previous_of(i), sub.dt);
    const double ahead = hit_[i] != 0 ? 0.0 : share;
    const Vec6 pushed = turns_forces ? Vec6(ahead * bent_push_[i]) : Vec6(Vec6::Zero());
    const Vec3 bent = pushed.tail<3>();
    state.u_synchronised[i] = state.u[i] + ahead * (state.u[i] - sub.u_before[i]);
    if (hit_[i] != 0 && !sub.gain.empty() && !rests(hit_[i], state.u[i], sub.gain[i]))
      state.u_synchronised[i] += share * sub.gain[i];
    state.u_synchronised[i].head<3>() += sub.inverse_mass[i].linear * pushed.head<3>();
    if (turns_otherwise(sub, i)) {
      synchronise_spin(sub, i, ahead, bent, state);
    } else {
      state.u_synchronised[i].tail<3>() += sub.inverse_mass[i].angular * bent;
    }
  }
}

// In a sub-step with an impact, marks the bodies with constraint forces, which may include the
// impact. Bodies in free flight are extrapolated.
void Euler::find_hit(const Substep& sub) {
  hit_.assign(sub.u_before.size(), 0);
  if (sub.smooth) return;
  for (std::size_t i = 0; i < sub.rows.size(); ++i) {
    const Block& block = sub.rows[i];
    const bool acts = !block.is_unilateral() || block.impulse[0] > 0.0 ||
                      (!sub.struck.empty() && sub.struck[i] != 0 && sub.gain.empty());
    if (!acts) continue;
    const bool arrives = !sub.gain.empty() && block.is_unilateral() &&
                         block.phi[0] > sub.dt * speed_by_forces(sub, block);
    for (const int body : {block.a, block.b}) {
      if (body < 0) continue;
      std::uint8_t& hit = hit_[index(body)];
      hit = arrives && hit != kHit ? kArrives : kHit;
    }
  }
}

// (J+ - J)^T impulse.
void Euler::turn_joint_forces(const Substep& sub, const State& state) {
  bent_push_.assign(state.u.size(), Vec6::Zero());
  const auto motion_of = [&](int body) {
    return body < 0 ? Motion{} : motion(state.u[index(body)], sub.dt);
  };
  Vec6 unmoved = Vec6::Zero();  // for the world and static bodies
  for (const Block& block : sub.rows) {
    if (block.is_contact()) continue;
    Vec6& on_a = block.a < 0 ? unmoved : bent_push_[index(block.a)];
    Vec6& on_b = block.b < 0 ? unmoved : bent_push_[index(block.b)];
    with_joint_rows(block.kind, [&](auto joint) {
      joint.push_change(block, motion_of(block.a), motion_of(block.b), block.impulse, on_a, on_b);
    });
  }
  if (sub.scene->effects.armature) resist_by_armatures(sub);
}

// Armatures resist what turns the forces: of a push b, A (M + A)^-1 b is theirs, with A = a J^T J
// of a body's own rows. Without it the speed of a light body with a large armature would be far
// off.
void Euler::resist_by_armatures(const Substep& sub) {
  const auto resists = [](const Mat3& M, const Mat3& A, auto push) {
    push -= A * Vec3((M + A).inverse() * push);
  };
  resisting_.assign(bent_push_.size(), {});
  for (const Block& row : sub.rows) {
    if (!row.is_coordinate() || !is_armature(row)) continue;
    for (const bool of_a : {true, false}) {
      const int body = of_a ? row.a : row.b;
      if (body < 0) continue;
      const Vec6 J = gradient(row, 0, of_a);
      Resisting& sum = resisting_[index(body)];
      sum.any = true;
      sum.linear += row.armature * J.head<3>() * J.head<3>().transpose();
      if (row.position_rows == 0) {
        sum.angular += row.armature * J.tail<3>() * J.tail<3>().transpose();
      }
    }
  }
  for (std::size_t i = 0; i < resisting_.size(); ++i) {
    if (!resisting_[i].any) continue;
    const Body& body = sub.scene->bodies[i];
    const Mat3 I = sub.R_WB[i] * body.inertia.asDiagonal() * sub.R_WB[i].transpose();
    resists(body.mass * Mat3::Identity(), resisting_[i].linear, bent_push_[i].head<3>());
    resists(I, resisting_[i].angular, bent_push_[i].tail<3>());
  }
}

void Euler::synchronise_spin(const Substep& sub, std::size_t body, double ahead, const Vec3& bent,
                             State& state) const {
  const Vec3& I = sub.scene->bodies[body].inertia;
  const Quat& q = state.q[body];
  const Vec3 omega_B = q.conjugate() * Vec3(state.u[body].tail<3>());
  auto omega = state.u_synchronised[body].tail<3>();
  if (tumbles(sub, body) && keeps_momentum(body)) {
    const Vec3 pushed =
        q.conjugate() * Vec3(ahead * sub.impulse_time[body] * state.torque[body] + bent);
    omega = q * (momentum_after(I, omega_B, sub.dt) + pushed).cwiseQuotient(I);
  } else {
    // u_before includes this torque up to the middle of the sub-step; the other half is added here.
    omega += q * Vec3(gyroscopic_explicit(I, omega_B, 0.5 * sub.dt) - omega_B) +
             sub.inverse_mass[body].angular * bent;
  }
  keep_finite(sub.scene->bodies[body], state.u[body], state.u_synchronised[body]);
}

}  // namespace substep
