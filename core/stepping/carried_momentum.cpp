#include "core/stepping/carried_momentum.hpp"

#include "core/math/gyroscopic.hpp"
#include "core/stepping/gyroscopic_stage.hpp"
#include "core/stepping/integrate.hpp"

namespace substep {

Vec3 momentum_at_start(const Substep& sub, const State& state, std::size_t body) {
  return momentum_after(sub.scene->bodies[body].inertia,
                        sub.R_WB[body].transpose() * state.u[body].tail<3>(),
                        state.dt_previous_of(body));
}

Vec3 momentum_of(const Substep& sub, std::size_t body, const Vec6& u) {
  const Mat3& R = sub.R_WB[body];
  return R * sub.scene->bodies[body].inertia.cwiseProduct(R.transpose() * u.tail<3>());
}

Vec3 velocity_of(const Substep& sub, std::size_t body, const Vec3& l) {
  const Mat3& R = sub.R_WB[body];
  return R * (R.transpose() * l).cwiseQuotient(sub.scene->bodies[body].inertia);
}

void turn_momentum(const Substep& sub, std::size_t body, const Quat& turn, State& state) {
  state.u[body].tail<3>() = velocity_of(sub, body, turn * momentum_of(sub, body, state.u[body]));
}

void settle_momentum(const Substep& sub, State& state) {
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!tumbles(sub, i)) continue;
    const Quat to_body = state.q[i].conjugate();
    const Vec3 l = to_body * momentum_of(sub, i, state.u[i]);
    const Vec3 guess = to_body * Vec3(state.u[i].tail<3>());
    const Vec3 omega =
        state.q[i] * velocity_of_momentum(sub.scene->bodies[i].inertia, l, -sub.dt, guess);
    if (omega.allFinite()) state.u[i].tail<3>() = omega;
  }
}

void synchronise_by(const Substep& sub, std::size_t body, const Vec6& gained, State& state) {
  state.u_synchronised[body] = state.u[body] + gained;
  if (!tumbles(sub, body)) return;
  const Vec3& I = sub.scene->bodies[body].inertia;
  const Quat& q = state.q[body];
  const Vec3 omega_B = q.conjugate() * Vec3(state.u[body].tail<3>());
  state.u_synchronised[body].tail<3>() =
      q * Vec3((momentum_after(I, omega_B, sub.dt) + q.conjugate() * Vec3(gained.tail<3>()))
                   .cwiseQuotient(I));
  keep_finite(sub.scene->bodies[body], state.u[body], state.u_synchronised[body]);
}

}  // namespace substep
