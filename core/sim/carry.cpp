// What a sub-step takes from the one before and leaves to the next (Carried): forces, and how
// forces and velocities change where a method goes by that.

#include <algorithm>

#include "core/sim/simulator_impl.hpp"
#include "core/stepping/stormer.hpp"

namespace substep {

double Simulator::Impl::dt_previous_of(const Block& block) const {
  const double a = block.a < 0 ? 0.0 : state.dt_previous_of(static_cast<std::size_t>(block.a));
  const double b = block.b < 0 ? 0.0 : state.dt_previous_of(static_cast<std::size_t>(block.b));
  return std::max(a, b);
}

bool Simulator::Impl::forces_are_stored() const {
  return contact || starts_from_last_forces(settings);
}

void Simulator::Impl::seed_forces() {
  std::size_t next = 0;  // blocks mostly come in the order of the last sub-step
  const bool goes_on = open && !schedule.first_of_part();
  const std::span<const StoredForce> of_last =
      goes_on ? std::span<const StoredForce>(forces).subspan(first_force) : state.forces;
  const std::size_t known = of_last.size();
  const bool all_are_stored = starts_from_last_forces(settings);
  const bool extrapolated = extrapolates(settings);
  for (Block& block : rows()) {
    for (double& impulse : block.impulse) impulse = 0.0;
    block.seeded = false;
    if (block.is_contact()) {
      for (std::int8_t& tight : block.tight) tight = kUnknownSet;
      block.was_closed = false;
    } else if (!all_are_stored) {
      continue;
    }
    for (std::size_t tried = 0; tried < known; ++tried) {
      const StoredForce& force = of_last[next];
      next = next + 1 < known ? next + 1 : 0;
      if (force.id != block.id) continue;
      const double time = impulse_time_of(block);
      for (int row = 0; row < block.rows; ++row) {
        block.impulse[row] = force.lambda[row] * time;
        if (block.is_contact()) block.tight[row] = force.tight[row];
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

void Simulator::Impl::hand_over(double dt) {
  if (state.acceleration_change.empty()) return;
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (impulse_time[i] == dt || state.acceleration_change[i].isZero(0.0)) continue;
    state.u[i] += stormer_hand_over(state.acceleration_change[i], dt, impulse_time[i]);
  }
}

void Simulator::Impl::store_accelerations(double dt) {
  const bool follows = follows_accelerations(settings);
  if (!follows) state.acceleration_change.clear();
  if (!follows && !extrapolates(settings)) return state.acceleration.clear();
  state.acceleration.resize(state.u.size(), Vec6::Zero());
  if (follows) state.acceleration_change.resize(state.u.size(), Vec6::Zero());
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    Vec6 a = Vec6::Zero();
    if (smooth) a = (1.0 / impulse_time[i]) * (state.u[i] - u_before[i]);
    if (follows) {
      const bool known = smooth && !state.acceleration[i].isZero(0.0);
      state.acceleration_change[i] =
          known ? Vec6(stormer_growth(dt, impulse_time[i]) * (a - state.acceleration[i]))
                : Vec6(Vec6::Zero());
    }
    state.acceleration[i] = a;
  }
}

// Joints are to hold where the poses go, from where accelerations that go on changing as they did
// would lead.
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
    motions[i] =
        motion(stormer_velocity(u_guess[i], u_before[i], a, change, dt, impulse_time[i]), dt);
  }
  aim_at_stormer_poses(rows(), state.acceleration, u_guess, motions, impulse_time, dt);
}

// An impact is no acceleration: poses go with the velocities then.
std::span<const Vec6> Simulator::Impl::pose_velocities(double dt) {
  if (!follows_accelerations(settings) || !smooth) return state.u;
  for (auto* of_bodies : {&state.acceleration, &state.acceleration_change, &w}) {
    of_bodies->resize(state.u.size(), Vec6::Zero());
  }
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    w[i] = stormer_velocity(state.u[i], u_before[i], state.acceleration[i],
                            state.acceleration_change[i], dt, impulse_time[i]);
  }
  return w;
}

// The gain about this sub-step, half of what comes between the forces of its neighbours, is a
// sub-step and a half after the one that is known.
void Simulator::Impl::extrapolate(const StoredForce& force, Block& block) const {
  const double dt = dt_previous_of(block);  // between the poses of two forces
  const double time = impulse_time_of(block);
  for (int row = 0; row < block.rows; ++row) {
    block.last[row] = force.lambda[row];
    block.last_rate[row] = force.rate[row];
    block.gain[row] = time * dt * (force.rate[row] + 1.5 * dt * force.rate_change[row]);
  }
}

void Simulator::Impl::find_rates(const Block& block, StoredForce& force) const {
  const double dt = dt_previous_of(block);
  if (dt == 0.0) return;
  const double per_dt = 1.0 / dt;
  for (int row = 0; row < block.rows; ++row) {
    force.rate[row] = per_dt * (block.lambda[row] - block.last[row]);
    if (block.last_rate[row] != 0.0) {
      force.rate_change[row] = per_dt * (force.rate[row] - block.last_rate[row]);
    }
  }
}

void Simulator::Impl::store_forces() {
  forces.resize(first_force);
  const bool extrapolated = extrapolates(settings);
  const bool all_are_stored = starts_from_last_forces(settings);
  for (Block& block : rows()) {
    if (!block.is_contact() && !all_are_stored) continue;
    set_lambda(block);
    StoredForce& force = forces.emplace_back();
    force.id = block.id;
    for (int row = 0; row < block.rows; ++row) {
      force.lambda[row] = block.lambda[row];
      force.tight[row] = block.tight[row];
    }
    if (extrapolated && block.seeded) find_rates(block, force);
  }
}

}  // namespace substep
