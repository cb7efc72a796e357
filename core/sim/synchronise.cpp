// Synchronises velocities to the poses; stored velocities are half a sub-step older.

#include <algorithm>
#include <cmath>

#include "core/math/gyroscopic.hpp"
#include "core/sim/energy.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {

// In a sub-step with an impact, marks the bodies with constraint forces, which may include the
// impact. Bodies in free flight are extrapolated.
void Simulator::Impl::find_struck() {
  hit.assign(state.u.size(), 0);
  if (smooth) return;
  const std::span<const Block> own = rows();
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Block& block = own[i];
    const bool acts =
        !block.is_contact() || block.impulse[0] > 0.0 || (restitution && restitution->struck(i));
    for (const int body : {block.a, block.b}) {
      if (acts && body >= 0) hit[index(body)] = 1;
    }
  }
}

// Applies the forces of the sub-step for half of its length; marked bodies are skipped. Joint
// forces are applied along the rows at the new poses, where they do no work and conserve the
// angular momentum about a fixed anchor.
void Simulator::Impl::synchronise(double dt) {
  if (extends_changes()) return extend_changes(dt);
  if (extrapolates(settings) && smooth) return extend_courses(dt);
  const auto ahead_after = [&](double dt_previous) {
    const double before =
        settings.integrator == Integrator::kEuler && dt_previous == 0.0 ? dt : dt_previous;
    return dt / (before + dt);
  };
  const double ahead_of_all = ahead_after(state.dt_previous);
  // Newton and XPBD already apply forces along rows at later poses.
  const bool turns_forces =
      joints && settings.solver != SolverKind::kNewton && settings.solver != SolverKind::kXpbd;
  if (turns_forces) turn_joint_forces(dt);
  find_struck();
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    const double ahead = hit[i] != 0         ? 0.0
                         : state.own.empty() ? ahead_of_all
                                             : ahead_after(state.own[i].dt_previous);
    const Vec6 pushed = turns_forces ? Vec6(ahead * bent_push[i]) : Vec6(Vec6::Zero());
    const Vec3 bent = pushed.tail<3>();
    state.u_synchronised[i] = state.u[i] + ahead * (state.u[i] - u_before[i]);
    state.u_synchronised[i].head<3>() += inverse_mass[i].linear * pushed.head<3>();
    if (turns_otherwise(i)) {
      synchronise_spin(i, ahead, bent, dt);
    } else {
      state.u_synchronised[i].tail<3>() += inverse_mass[i].angular * bent;
    }
  }
}

// The change of the joints' impulses as their bodies move: (J+ - J)^T impulse [N s, N m s].
void Simulator::Impl::turn_joint_forces(double dt) {
  bent_push.assign(state.u.size(), Vec6::Zero());
  const auto motion_of = [&](int body) {
    return body < 0 ? Motion{} : motion(state.u[index(body)], dt);
  };
  Vec6 unmoved = Vec6::Zero();  // for the world and static bodies
  for (const Block& block : rows()) {
    if (block.is_contact()) continue;
    Vec6& on_a = block.a < 0 ? unmoved : bent_push[index(block.a)];
    Vec6& on_b = block.b < 0 ? unmoved : bent_push[index(block.b)];
    with_joint_rows(block.kind, [&](auto joint) {
      joint.push_change(block, motion_of(block.a), motion_of(block.b), block.impulse, on_a, on_b);
    });
  }
}

void Simulator::Impl::synchronise_spin(std::size_t body, double ahead, const Vec3& bent,
                                       double dt) {
  const Vec3& I = scene->bodies[body].inertia;
  const Quat& q = state.q[body];
  const Vec3 omega_B = q.conjugate() * Vec3(state.u[body].tail<3>());
  auto omega = state.u_synchronised[body].tail<3>();
  if (tumbles(body) && spins[body].out_of_axis && !spins[body].damped) {
    const Vec3 pushed =
        q.conjugate() * Vec3(ahead * impulse_time[body] * state.torque[body] + bent);
    omega = q * (momentum_after(I, omega_B, dt) + pushed).cwiseQuotient(I);
  } else {
    // u_before includes this torque up to the middle of the sub-step; the other half is added here.
    omega += q * Vec3(gyroscopic_explicit(I, omega_B, 0.5 * dt) - omega_B) +
             inverse_mass[body].angular * bent;
  }
  keep_finite(body);
}

// Gyroscopic torques are quadratic in speed and may overflow first.
void Simulator::Impl::keep_finite(std::size_t body) {
  if (std::isfinite(most_kinetic(scene->bodies[body], state.u_synchronised[body]))) return;
  state.u_synchronised[body] = state.u[body];
}

bool Simulator::Impl::extends_changes() const { return follows_accelerations(settings) && smooth; }

// Störmer's velocities are q' - dt^2/24 a' in the middle of a sub-step; from there on
//   q'+ = q' + dt (a/2 + 3/8 D + (D - D-)/3),
// with parabolic accelerations. For tumbling bodies likewise with momentum and torque.
void Simulator::Impl::extend_changes(double dt) {
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    const Changes& by = changes[i];
    state.u_synchronised[i] =
        state.u[i] + dt * (0.5 * by.a + 19.0 / 24.0 * by.now - 9.0 / 24.0 * by.before);
    if (!tumbles(i)) continue;
    const Vec3& I = scene->bodies[i].inertia;
    const Quat& q = state.q[i];
    const Vec3 omega_B = q.conjugate() * Vec3(state.u[i].tail<3>());
    const Vec3 pushed = dt * (0.5 * by.a + 19.0 / 24.0 * by.now - 9.0 / 24.0 * by.before).tail<3>();
    state.u_synchronised[i].tail<3>() =
        q * Vec3((momentum_after(I, omega_B, dt) + q.conjugate() * pushed).cwiseQuotient(I));
    keep_finite(i);
  }
}

// From the mean over the sub-step to its end, with parabolic accelerations:
//   q'+ = v + dt (a/6 + a+/3 - dt^2 a''/24).
void Simulator::Impl::extend_courses(double dt) {
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    const BodyCourse& by = courses[i];
    const Vec6 gained = dt * (by.start / 6.0 + by.end / 3.0 - by.bend / 24.0);
    state.u_synchronised[i] = state.u[i] + gained;
    if (!tumbles(i)) continue;
    const Vec3& I = scene->bodies[i].inertia;
    const Quat& q = state.q[i];
    const Vec3 omega_B = q.conjugate() * Vec3(state.u[i].tail<3>());
    const Vec3 pushed = q.conjugate() * Vec3(gained.tail<3>());
    state.u_synchronised[i].tail<3>() =
        q * Vec3((momentum_after(I, omega_B, dt) + pushed).cwiseQuotient(I));
    keep_finite(i);
  }
}

}  // namespace substep
