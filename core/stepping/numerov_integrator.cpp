#include <algorithm>
#include <vector>

#include "core/solver/numerov.hpp"
#include "core/stepping/carried_momentum.hpp"
#include "core/stepping/first_changes.hpp"
#include "core/stepping/integrate.hpp"
#include "core/stepping/leapfrog.hpp"

namespace substep {

/// Sub-steps around Newton with forces numerov (solver/numerov.hpp): it starts from extrapolated
/// forces and velocities, and returns the motion of the sub-step.
class Numerov : public Leapfrog {
 public:
  /// @param integrator that determines the duration of applied forces
  Numerov(const Scene& scene, const JointStage* joints, Integrator integrator)
      : Leapfrog(scene), joints_(joints), as_euler_(integrator == Integrator::kEuler) {}
  [[nodiscard]] double force_time(double dt_previous, double dt) const override {
    return as_euler_ ? Euler::force_time(dt_previous, dt) : Leapfrog::force_time(dt_previous, dt);
  }
  void begin(const Substep& sub, State& state) override;
  void seed(const StoredForce& of_last, const State& state, Block& block) const override;
  void extend(System& system, const Substep& sub, const State& state) override;
  void predict_velocities(const Substep& sub, const State& state, std::span<Vec6> w) const override;
  [[nodiscard]] bool starts_at_poses() const override { return false; }
  void forget(std::size_t body, State& state) const override {
    if (!state.acceleration.empty()) state.acceleration[body].setZero();
  }
  void settle(Substep& /*sub*/, State& /*state*/) override {}
  void store(const Substep& sub, const State& state, const Block& block,
             StoredForce& force) const override;
  void move_poses(const Substep& sub, State& state) override;
  void synchronise(const Substep& sub, State& state) override;

 protected:
  [[nodiscard]] double share_ahead(double dt_previous, double dt) const override {
    return as_euler_ ? Euler::share_ahead(dt_previous, dt) : Leapfrog::share_ahead(dt_previous, dt);
  }
  [[nodiscard]] bool keeps_momentum(std::size_t /*body*/) const override { return true; }

 private:
  void find_first_rates(const Substep& sub, State& state) const;

  const JointStage* joints_;
  bool as_euler_;
  std::vector<Vec6> u_guess_;
  std::vector<BodyCourse> courses_;
  std::vector<Vec3> inertia_;  // principal moments of tumbling bodies, else 0
  std::vector<Vec6> w_;
};

void Numerov::begin(const Substep& sub, State& state) {
  if (needs_first_changes(sub, state)) find_first_rates(sub, state);
  if (sub.settings.gyroscopic != Gyroscopic::kImplicit) return Leapfrog::begin(sub, state);
  if (sub.scene->effects.gyroscopic) resize_torques(state);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!tumbles(sub, i)) continue;
    const Vec3 l = momentum_at_start(sub, state, i);
    state.u[i].tail<3>() = sub.R_WB[i] * l.cwiseQuotient(sub.scene->bodies[i].inertia);
  }
}

// Forces of a joint as if stored by a sub-step before the first.
void Numerov::find_first_rates(const Substep& sub, State& state) const {
  const std::unique_ptr<Solver> solver = make_solver(SolverKind::kBpp);
  const auto [before, at_start, after] = first_accelerations(sub, state, joints_, *solver);
  const double dt = sub.dt;
  state.acceleration.resize(state.u.size(), Vec6::Zero());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    state.acceleration[i] = at_start.a[i];
    if (tumbles(sub, i)) {
      state.acceleration[i].tail<3>() = velocity_of(sub, i, at_start.torque[i]);
    }
  }
  for (std::size_t k = 0; k < at_start.lambda.size(); ++k) {
    const std::uint64_t id = sub.rows[k].id;
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
}

void Numerov::seed(const StoredForce& of_last, const State& state, Block& block) const {
  const double age = of_last.rate_age + dt_previous_of(state, block);
  for (int row = 0; row < block.rows; ++row) {
    block.last[row] = of_last.lambda[row];
    block.last_rate[row] = of_last.rate[row];
    block.rate_change[row] = of_last.rate_change[row];
    block.rate[row] = of_last.rate[row] + age * of_last.rate_change[row];
  }
  block.last_rate_age = of_last.rate_age;
}

void Numerov::extend(System& system, const Substep& sub, const State& state) {
  const std::size_t n = state.u.size();
  courses_.resize(n);
  inertia_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    inertia_[i] = tumbles(sub, i) ? sub.scene->bodies[i].inertia : Vec3(Vec3::Zero());
  }
  system.courses = courses_;
  system.inertia = inertia_;
  if (state.acceleration.empty()) return;
  u_guess_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    u_guess_[i] = sub.u_before[i] + sub.impulse_time[i] * state.acceleration[i];
  }
  system.u_guess = u_guess_;
}

void Numerov::store(const Substep& sub, const State& state, const Block& block,
                    StoredForce& force) const {
  if (!block.seeded) return;
  const double dt_previous = dt_previous_of(state, block);  // between the poses of the two forces
  const double bent = numerov_weights(sub.dt, dt_previous).bent(sub.dt);
  for (int row = 0; row < block.rows; ++row) {
    force.lambda[row] -= bent * block.rate_change[row];
    if (dt_previous == 0.0) {  // initial forces of the run
      force.rate[row] = block.rate[row];
      force.rate_change[row] = block.rate_change[row];
      continue;
    }
    force.rate[row] = (force.lambda[row] - block.last[row]) / dt_previous;
    if (block.last_rate[row] != 0.0) {
      const double apart = 0.5 * dt_previous + block.last_rate_age;
      force.rate_change[row] = (force.rate[row] - block.last_rate[row]) / apart;
    }
  }
  force.rate_age = 0.5 * dt_previous;
}

void Numerov::predict_velocities(const Substep& sub, const State& /*state*/,
                                 std::span<Vec6> w) const {
  for (const int body : sub.part->moving) w[index(body)] = courses_[index(body)].move_by;
}

void Numerov::move_poses(const Substep& sub, State& state) {
  state.acceleration_change.clear();  // of another method, outdated
  state.acceleration.resize(state.u.size(), Vec6::Zero());
  w_.resize(state.u.size());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    w_[i] = courses_[i].move_by;
    state.acceleration[i].setZero();
    if (sub.smooth) {
      state.acceleration[i] = (1.0 / sub.impulse_time[i]) * (state.u[i] - sub.u_before[i]);
    }
  }
  integrate(sub, w_, turn_momentum, state);
  settle_momentum(sub, state);
}

// From the mean over the sub-step to its end, with parabolic accelerations:
//   q'+ = v + dt (a/6 + a+/3 - dt^2 a''/24).
void Numerov::synchronise(const Substep& sub, State& state) {
  if (!sub.smooth) return Leapfrog::synchronise(sub, state);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    const BodyCourse& by = courses_[i];
    synchronise_by(sub, i, sub.dt * (by.start / 6.0 + by.end / 3.0 - by.bend / 24.0), state);
  }
}

std::unique_ptr<TimeIntegrator> make_numerov(const Scene& scene, const JointStage* joints,
                                             Integrator integrator) {
  return std::make_unique<Numerov>(scene, joints, integrator);
}

}  // namespace substep
