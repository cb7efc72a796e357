#include "core/math/free_turn.hpp"

#include "core/math/gyroscopic.hpp"
#include "core/math/turn.hpp"

namespace substep {

namespace {

/// True if all lie on one principal axis: then the body does not tumble.
bool on_an_axis(const Vec3& l, const Vec3& torque, const Vec3& change) {
  return (l.array() != 0.0 || torque.array() != 0.0 || change.array() != 0.0).count() <= 1;
}

}  // namespace

Vec3 free_turn(const Vec3& I, const Vec3& l, const Vec3& torque, const Vec3& torque_change,
               double dt) {
  if (on_an_axis(l, torque, torque_change)) {
    return dt * (l + dt / 12.0 * torque_change).cwiseQuotient(I);
  }
  constexpr int kIterations = 12;
  constexpr double kRelative = 1e-30;  // of |w|^2
  const Vec3 middle = l + dt / 24.0 * torque_change;
  Vec3 w = velocity_of_momentum(I, l, dt, l.cwiseQuotient(I));
  Vec3 half_turn = 0.5 * dt * w;
  Vec3 turn = dt * w;
  for (int i = 0; i < kIterations; ++i) {
    const Mat3 to_middle =
        turn_matrix(half_tangent_factor(0.5 * half_turn) * 0.5 * half_turn).transpose();
    const Vec3 next = (to_middle * middle).cwiseQuotient(I);
    const Vec3 tau = to_middle * torque;
    const Vec3 momentum_rate = gyroscopic_torque(I, next) + tau;
    const Vec3 rate = momentum_rate.cwiseQuotient(I);
    const Vec3 tau_rate = (1.0 / dt) * (to_middle * torque_change) + tau.cross(next);
    const Vec3 rate_change =
        (momentum_rate.cross(next) + I.cwiseProduct(next).cross(rate) + tau_rate).cwiseQuotient(I);
    const Vec3 bent = next.cross(rate);
    const double dt2 = dt * dt;
    half_turn = dt * (0.5 * next - dt / 8.0 * rate + dt2 * (rate_change / 48.0 + bent / 96.0));
    turn = dt * (next + dt2 * (rate_change / 24.0 + bent / 12.0));
    const double change = (next - w).squaredNorm();
    w = next;
    if (change <= kRelative * w.squaredNorm()) break;
  }
  return turn;
}

}  // namespace substep
