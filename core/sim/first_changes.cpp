// Störmer's method needs the change of accelerations, Numerov's the change of forces. Before the
// first sub-step they are computed from trial poses one sub-step before and after the start.

#include <algorithm>

#include "core/math/gyroscopic.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/external.hpp"
#include "core/stepping/integrate.hpp"
namespace substep {

namespace {
constexpr int kSolves = 5;  // at the start, and in two passes at both trial poses
}

bool Simulator::Impl::needs_first_changes() const {
  if (!open || !carries_momentum(settings) || contact || holds_grab()) return false;
  const std::vector<int>& moving = part().moving;
  return std::none_of(moving.begin(), moving.end(),
                      [&](int i) { return state.dt_previous_of(index(i)) > 0.0; });
}

// Errors of the trial velocities that are even in time cancel in the first difference, but not in
// the second; a second pass with the changes of the first is third order.
void Simulator::Impl::find_first_changes(double dt) {
  const std::size_t n = state.u.size();
  const Accelerations none{std::vector<Vec6>(n, Vec6::Zero()), {}, {}};
  const auto own = extrapolates(settings) ? make_solver(SolverKind::kBpp) : nullptr;
  Solver& linear = own ? *own : *solver;
  Accelerations at_start;
  find_accelerations(dt, 0.0, none.a, none.a, linear, at_start);
  Accelerations before;
  Accelerations after;
  std::vector<Vec6> rate = none.a;
  for (int pass = 0; pass < 2; ++pass) {
    find_accelerations(dt, -dt, at_start.a, rate, linear, before);
    find_accelerations(dt, dt, at_start.a, rate, linear, after);
    for (std::size_t i = 0; i < n; ++i) rate[i] = 0.5 / dt * (after.a[i] - before.a[i]);
  }
  if (extrapolates(settings)) return store_first_rates(dt, before, at_start, after);
  // A parabola through the three gives the change before the first of them.
  const auto change = [&](const auto& quantity, std::size_t i) {
    return (3.0 * quantity(at_start)[i] - 2.0 * quantity(before)[i] - quantity(after)[i]).eval();
  };
  state.acceleration.resize(n, Vec6::Zero());
  state.acceleration_change.resize(n, Vec6::Zero());
  resize_torques();
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    state.acceleration[i] = before.a[i];
    state.acceleration_change[i] = change([](const Accelerations& at) { return at.a; }, i);
    state.torque[i] = before.torque[i];
    state.torque_change[i] = change([](const Accelerations& at) { return at.torque; }, i);
  }
}

// Forces of a joint as if stored by a sub-step before the first.
void Simulator::Impl::store_first_rates(double dt, const Accelerations& before,
                                        const Accelerations& at_start, const Accelerations& after) {
  state.acceleration.resize(state.u.size(), Vec6::Zero());
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    state.acceleration[i] = at_start.a[i];
    if (tumbles(i)) state.acceleration[i].tail<3>() = velocity_of(i, at_start.torque[i]);
  }
  if (!joints) return;
  joints->append(part(), state, R_WB, blocks);
  for (std::size_t k = 0; k < at_start.lambda.size(); ++k) {
    const std::uint64_t id = rows()[k].id;
    const auto known = std::find_if(state.forces.begin(), state.forces.end(),
                                    [&](const StoredForce& force) { return force.id == id; });
    StoredForce& force = known == state.forces.end() ? state.forces.emplace_back() : *known;
    force.id = id;
    force.rate_age = 0.0;
    for (std::size_t row = 0; row < kMaxRows; ++row) {
      force.lambda[row] = at_start.lambda[k][row];
      force.rate[row] = (after.lambda[k][row] - before.lambda[k][row]) / (2.0 * dt);
      force.rate_change[row] =
          (after.lambda[k][row] - 2.0 * at_start.lambda[k][row] + before.lambda[k][row]) /
          (dt * dt);
    }
  }
  blocks.keep(first_block);
}

// Solves J a = -phi'' at the poses and velocities extrapolated by time s with accelerations `a` and
// their rate.
void Simulator::Impl::find_accelerations(double dt, double s, std::span<const Vec6> a,
                                         std::span<const Vec6> rate, Solver& linear,
                                         Accelerations& out) {
  const std::vector<Vec3> x = state.x;
  const std::vector<Quat> q = state.q;
  const std::size_t n = state.u.size();
  std::vector<Vec6> u(n, Vec6::Zero());
  std::vector<Vec6> way(n, Vec6::Zero());
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    way[i] = state.u[i] + 0.5 * s * a[i];
    u[i] = state.u[i] + s * a[i] + 0.5 * s * s * rate[i];
  }
  integrate(part(), s, way, state);
  turn_axes(part().moving);
  substep::inverse_mass(inertia_inverse, part(), R_WB, inverse_mass);
  blocks.keep(first_block);
  if (joints) joints->append(part(), state, R_WB, blocks);
  set_acceleration_rows(rows(), u, inverse_mass, dt, scene->regularisation);

  out.a.assign(n, Vec6::Zero());
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    if (!tumbles(i)) continue;
    const Vec3& I = scene->bodies[i].inertia;
    const Vec3 omega_B = R_WB[i].transpose() * u[i].tail<3>();
    out.a[i].tail<3>() = R_WB[i] * gyroscopic_torque(I, omega_B).cwiseQuotient(I);
  }
  const std::vector<Vec6> free = out.a;
  for (const int body : part().moving) {
    if (scene->effects.gravity) out.a[index(body)].head<3>() = scene->gravity;
  }
  if (scene->effects.external) {
    const std::vector<double> one(n, 1.0);
    add_external(*scene, part(), inertia_inverse, R_WB, one, out.a);
  }
  for (const Block& block : rows()) apply_impulse(block, block.given, inverse_mass, out.a);
  System system{rows(), inverse_mass, out.a, free, 1.0, R_WB, scene->regularisation, {}};
  system.limits = limits_of_solve(progress(*open), settings, budget);
  system.limits.work /= kSolves;  // if this is too little, it is for the sub-step too
  if (linear.solve(system, settings).status == SolveStatus::kOverLimits) out.a = free;
  out.lambda.clear();
  for (const Block& block : rows()) {
    auto& lambda = out.lambda.emplace_back();
    for (int row = 0; row < kMaxRows; ++row) {
      lambda[index(row)] = row < block.rows ? block.impulse[row] : 0.0;
    }
  }
  out.torque.assign(n, Vec3::Zero());
  for (const int body : part().moving) {
    const std::size_t i = index(body);
    if (tumbles(i)) out.torque[i] = momentum_of(i, out.a[i] - free[i]);
  }
  blocks.keep(first_block);
  state.x = x;
  state.q = q;
  turn_axes(part().moving);
}

}  // namespace substep
