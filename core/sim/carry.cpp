// Data passed between sub-steps (Carried): forces, and the rates of forces and velocities for
// methods that use them.

#include <algorithm>

#include "core/constraints/grab_rows.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/solver/numerov.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/stormer.hpp"

namespace substep {

double Simulator::Impl::dt_previous_of(const Block& block) const {
  const double a = block.a < 0 ? 0.0 : state.dt_previous_of(static_cast<std::size_t>(block.a));
  const double b = block.b < 0 ? 0.0 : state.dt_previous_of(static_cast<std::size_t>(block.b));
  return std::max(a, b);
}

bool Simulator::Impl::forces_are_stored() const {
  return contact || starts_from_last_forces(settings) || springs_are_stored();
}

bool Simulator::Impl::springs_are_stored() const {
  return has_springs && drift_law(settings) == Drift::kSoft;
}

SubstepTimes Simulator::Impl::times_of(const Block& block, double dt) const {
  return {dt, dt_previous_of(block), impulse_time_of(block)};
}

void Simulator::Impl::set_joint_springs(double dt) {
  const double rate = drift_rate(drift_law(settings), settings.drift_tau, dt);
  const bool stored = springs_are_stored();
  if (!stored && !averages_springs(settings)) return;  // plain Eq. 3
  for (Block& block : rows()) {
    if (block.is_contact() || is_grab(block)) continue;
    // At the start and after the probe, all of phi is elastic.
    const bool known = stored && block.seeded && dt_previous_of(block) > 0.0;
    if (!known) std::copy_n(block.phi, kMaxRows, block.elastic);
    set_springs(settings, times_of(block, dt), rate, inverse_mass, u_start, scene->regularisation,
                block);
  }
}

bool Simulator::Impl::averages_contacts() const {
  return scene->contact.compliance >= kSoftContact && drift_law(settings) == Drift::kFull &&
         averages_springs(settings);
}

void Simulator::Impl::set_contact_springs(double dt) {
  for (Block& block : rows()) {
    if (!block.is_contact()) continue;
    set_contact_spring(settings, times_of(block, dt), inverse_mass, u_start, scene->regularisation,
                       block);
  }
}

void Simulator::Impl::seed_forces() {
  std::size_t next = 0;  // blocks are mostly in the order of the last sub-step
  const bool goes_on = open && !schedule.first_of_part();
  const std::span<const StoredForce> of_last =
      goes_on ? std::span<const StoredForce>(forces).subspan(first_force) : state.forces;
  const std::size_t known = of_last.size();
  const bool all_are_stored = starts_from_last_forces(settings);
  const bool extrapolated = extrapolates(settings);
  const bool springs = springs_are_stored();
  for (Block& block : rows()) {
    for (double& impulse : block.impulse) impulse = 0.0;
    block.seeded = false;
    if (block.is_contact()) {
      std::fill_n(block.active_set, kMaxRows, kUnknownSet);
      block.was_closed = false;
      block.elastic[0] = 0.0;
    } else if (!all_are_stored && !springs) {
      continue;
    }
    for (std::size_t tried = 0; tried < known; ++tried) {
      const StoredForce& force = of_last[next];
      next = next + 1 < known ? next + 1 : 0;
      if (force.id != block.id) continue;
      const double time = impulse_time_of(block);
      const bool seeds = block.is_contact() || all_are_stored;
      for (int row = 0; row < block.rows; ++row) {
        block.elastic[row] = force.elastic[row];
        if (seeds) block.impulse[row] = force.lambda[row] * time;
        if (block.is_contact()) block.active_set[row] = force.active_set[row];
      }
      block.was_closed = force.lambda[0] > 0.0;
      block.seeded = true;
      if (extrapolated) extrapolate(force, block);
      break;
    }
  }
}

std::span<const Vec6> Simulator::Impl::extrapolated_velocities() {
  if (!extrapolates(settings) || state.acceleration.empty()) return {};
  u_guess.resize(u_before.size());
  for (std::size_t i = 0; i < u_guess.size(); ++i) {
    u_guess[i] = u_before[i] + impulse_time[i] * state.acceleration[i];
  }
  return u_guess;
}

void Simulator::Impl::prepare_courses() {
  momentum_inertia.resize(state.u.size());
  courses.resize(state.u.size());
  for (std::size_t i = 0; i < momentum_inertia.size(); ++i) {
    momentum_inertia[i] = tumbles(i) ? scene->bodies[i].inertia : Vec3(Vec3::Zero());
  }
}

void Simulator::Impl::correct_velocity_for_step_change(double dt) {
  if (state.acceleration_change.empty()) return;
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (impulse_time[i] == dt || state.acceleration_change[i].isZero(0.0)) continue;
    Vec6 correction = stormer_step_change(dt, impulse_time[i]) * state.acceleration_change[i];
    if (tumbles(i)) correction.tail<3>().setZero();  // carry_momentum()
    state.u[i] += correction;
  }
}

void Simulator::Impl::store_accelerations(double dt) {
  const bool follows = follows_accelerations(settings);
  if (!follows) state.acceleration_change.clear();
  if (!follows && !extrapolates(settings)) return state.acceleration.clear();
  state.acceleration.resize(state.u.size(), Vec6::Zero());
  if (follows) {
    state.acceleration_change.resize(state.u.size(), Vec6::Zero());
    changes.resize(state.u.size());
  }
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    Vec6 a = Vec6::Zero();
    if (smooth) a = (1.0 / impulse_time[i]) * (state.u[i] - u_before[i]);
    if (follows) store_changes(i, a, dt);
    state.acceleration[i] = a;
  }
}

// correct_velocity_for_step_change() used the change of the sub-step before last; the current one
// is now known, so the difference is added. Poses are not corrected: they satisfy the constraints.
void Simulator::Impl::store_changes(std::size_t body, const Vec6& a, double dt) {
  const bool known = smooth && !state.acceleration[body].isZero(0.0);
  const double growth = known ? stormer_growth(dt, impulse_time[body]) : 0.0;
  const double late =
      known && impulse_time[body] != dt ? 1.5 * stormer_step_change(dt, impulse_time[body]) : 0.0;
  const Vec6 change = a - state.acceleration[body];
  changes[body] = {a, growth * change, growth * state.acceleration_change[body]};
  Vec6 correction = late * (change - state.acceleration_change[body]);
  state.acceleration_change[body] = growth * change;
  if (tumbles(body)) {
    const Vec3 torque = smooth ? torque_of(body) : Vec3::Zero();
    const Vec3 torque_change = torque - state.torque[body];
    changes[body].a.tail<3>() = torque;
    changes[body].now.tail<3>() = growth * torque_change;
    changes[body].before.tail<3>() = growth * state.torque_change[body];
    correction.tail<3>() = velocity_of(body, late * (torque_change - state.torque_change[body]));
    state.torque_change[body] = growth * torque_change;
    state.torque[body] = torque;
  }
  if (late != 0.0 && correction.allFinite()) state.u[body] += correction;
}

// Joints must hold at the end poses; rows are linearised about poses extrapolated with the last
// change of acceleration.
void Simulator::Impl::aim_at_poses(double dt) {
  for (auto* of_bodies : {&state.acceleration, &state.acceleration_change, &u_guess}) {
    of_bodies->resize(state.u.size(), Vec6::Zero());
  }
  motions.resize(state.u.size());
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    const Vec6& a = state.acceleration[i];
    const Vec6& change = state.acceleration_change[i];
    u_guess[i] = u_before[i] + impulse_time[i] * (a + change);
    Vec6 w_guess = stormer_velocity(u_guess[i], u_before[i], a, change, dt, impulse_time[i]);
    if (tumbles(i)) {
      const Vec3 torque = state.torque[i] + state.torque_change[i];
      const Vec3 l = momentum_of(i, u_before[i]) + impulse_time[i] * torque;
      u_guess[i].tail<3>() = velocity_of(i, l);
      w_guess.tail<3>() = turn_velocity(i, l, torque, dt);
    }
    motions[i] = motion(w_guess, dt);
  }
  aim_at_stormer_poses(rows(), state.acceleration, u_guess, motions, impulse_time, dt);
}

// In a sub-step with an impact, which is not an acceleration, poses move by the velocities.
std::span<const Vec6> Simulator::Impl::pose_velocities(double dt) {
  if (extrapolates(settings)) {
    w.resize(state.u.size());
    for (const int body : part().moving) w[index(body)] = courses[index(body)].move_by;
    return w;
  }
  if (!follows_accelerations(settings)) return state.u;
  for (auto* of_bodies : {&state.acceleration, &state.acceleration_change, &w}) {
    of_bodies->resize(state.u.size(), Vec6::Zero());
  }
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    w[i] = smooth ? stormer_velocity(state.u[i], u_before[i], state.acceleration[i],
                                     state.acceleration_change[i], dt, impulse_time[i])
                  : state.u[i];
    if (tumbles(i)) {
      const Vec3 l = momentum_of(i, state.u[i]);
      w[i].tail<3>() = turn_velocity(i, l, smooth ? torque_of(i) : Vec3::Zero(), dt);
    }
  }
  return w;
}

void Simulator::Impl::extrapolate(const StoredForce& force, Block& block) const {
  const double age = force.rate_age + dt_previous_of(block);
  for (int row = 0; row < block.rows; ++row) {
    block.last[row] = force.lambda[row];
    block.last_rate[row] = force.rate[row];
    block.rate_change[row] = force.rate_change[row];
    block.rate[row] = force.rate[row] + age * force.rate_change[row];
  }
  block.last_rate_age = force.rate_age;
}

void Simulator::Impl::find_rates(const Block& block, StoredForce& force) const {
  const double dt = dt_previous_of(block);  // time between the poses of the two forces
  const double bent = numerov_weights(schedule.dt(), dt).bent(schedule.dt());
  for (int row = 0; row < block.rows; ++row) force.lambda[row] -= bent * block.rate_change[row];
  for (int row = 0; row < block.rows; ++row) {
    if (dt == 0.0) {  // initial forces of the run
      force.rate[row] = block.rate[row];
      force.rate_change[row] = block.rate_change[row];
      continue;
    }
    force.rate[row] = (force.lambda[row] - block.last[row]) / dt;
    if (block.last_rate[row] != 0.0) {
      const double apart = 0.5 * dt + block.last_rate_age;
      force.rate_change[row] = (force.rate[row] - block.last_rate[row]) / apart;
    }
  }
  force.rate_age = 0.5 * dt;
}

void Simulator::Impl::store_forces() {
  forces.resize(first_force);
  const bool extrapolated = extrapolates(settings);
  const bool all_are_stored = starts_from_last_forces(settings);
  const bool soft = drift_law(settings) == Drift::kSoft;
  const bool springs = springs_are_stored();
  for (Block& block : rows()) {
    if (!block.is_contact() && !all_are_stored && !springs) continue;
    find_lambda(block, block.lambda);
    StoredForce& force = forces.emplace_back();
    force.id = block.id;
    for (int row = 0; row < block.rows; ++row) {
      force.lambda[row] = block.lambda[row];
      force.active_set[row] = block.active_set[row];
    }
    if (extrapolated && block.seeded) find_rates(block, force);
    if (!soft || is_grab(block)) continue;
    if (block.is_contact()) {
      force.elastic[0] = -block.C[0] * block.lambda[0];
    } else if (springs) {
      store_elastic(block.lambda, block);
      std::copy_n(block.elastic, block.rows, force.elastic);
    }
  }
}

}  // namespace substep
