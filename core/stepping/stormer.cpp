#include <vector>

#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/grab_rows.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/math/free_turn.hpp"
#include "core/solver/cost_model.hpp"
#include "core/stepping/carried_momentum.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/first_changes.hpp"
#include "core/stepping/integrate.hpp"
#include "core/stepping/leapfrog.hpp"
#include "core/stepping/rolling.hpp"

namespace substep {

// Störmer's fourth-order method (1907), one solve per sub-step:
//   q+ - 2 q + q- = dt^2/12 (14 a - 5 a- + 4 a-- - a---).
// It is leapfrog, u+ = u + dt a, with poses corrected for the change of acceleration: with
// D = a - a-,
//   q+ = q + dt w,   w = u+ + dt/12 (2 D - D-).
// On the model of Eq. 5 it is stable while dt^2 k < 2 M, and damps motion near that limit. The
// constraints must hold at q+. With a = (u+ - u)/t (t: duration of forces, dt) w is linear in u+:
//   w = g u+ + known terms,   g = 1 + dt/(6 t),
// and the rows, linearised about the poses q^ extrapolated with the last change of acceleration,
// w^ = w(u^), become
//   phi(q^)/dt + J (w - w^) = 0,   or   J u+ - J u^ + phi(q^)/(g dt) = 0.
// For a tumbling body w is not linear in u+: a change of its momentum turns with the body. On
// average over the sub-step, an impulse P changes w by R I^-1 R^T P with R in the middle of it. The
// solve therefore uses this inverse mass. With R at the start, the error of w about a thin axis is
// dt omega times the ratio of the moments, and the extrapolations of the next sub-step amplify it:
// a rod of 1 : 70 that turns by 0.08 rad per sub-step about a hinge left its plane.
// If dt differs from the previous dt-, the changes are scaled (D and D- by dt/dt-, hence
// g = 1 + dt/dt- dt/(6 t)), and the dt^2 term omitted from the velocities is corrected:
//   u = q' - dt^2/24 a'  in the middle of a sub-step, so that  u += (dt^2 - dt-^2)/12 a'.
// Rotations do not commute: by Magnus' expansion a body with changing angular velocity rotates by
// dt w + dt^3/12 w' x w in world axes. (For tumbling bodies see free_turn.hpp.) The Cayley vector
// of integrate() is dt w/2; that of a rotation by dt |w| is longer by a relative (dt |w|/2)^2/3.

/// Needs solvers that hold the rows as they are given. In sub-steps with an impact, which is not an
/// acceleration, it is leapfrog.
class Stormer : public Leapfrog {
 public:
  Stormer(const Scene& scene, const JointStage* joints) : Leapfrog(scene), joints_(joints) {}
  void begin(const Substep& sub, State& state) override;
  std::int64_t aim(const Substep& sub, State& state) override;
  void extend(System& system, const Substep& sub, const State& state) override;
  /// The change of acceleration is unknown when a contact with a resolved spring opens or closes.
  [[nodiscard]] bool breaks_motion(const Block& contact) const override;
  [[nodiscard]] double motion_gain(const Substep& sub, const State& state,
                                   const Block& block) const override;
  [[nodiscard]] bool knows_motion(const Substep& sub) const override;
  void predict_velocities(const Substep& sub, const State& state, std::span<Vec6> w) const override;
  void forget(std::size_t body, State& state) const override;
  void settle(Substep& sub, State& state) override;
  void move_poses(const Substep& sub, State& state) override;
  void synchronise(const Substep& sub, State& state) override;
  /// As the velocities that the rows hold: of the carried momentum, with the inertia at the poses.
  [[nodiscard]] std::span<const Vec6> velocities_at_start(const Substep& sub) const override {
    return sub.u_before;
  }

 protected:
  [[nodiscard]] bool keeps_momentum(std::size_t /*body*/) const override { return true; }

 private:
  void find_first_changes(const Substep& sub, State& state) const;
  std::int64_t aim_at_poses(const Substep& sub, State& state);
  [[nodiscard]] Vec6 velocity_at_start(const Substep& sub, std::size_t body, const Vec6& u) const;
  void store_changes(const Substep& sub, std::size_t body, const Vec6& a, State& state);

  const JointStage* joints_;
  std::vector<Vec6> u_free_;   // before the rows act
  std::vector<Vec6> u_guess_;  // u^
  std::vector<Vec6> w_;
  // Of tumbling bodies, predicted for the middle of the sub-step. Not used beside contacts and
  // limits, whose impacts are solved with the inverse mass at the start, nor if a mode replaces it.
  bool solves_in_middle_ = false;
  std::vector<Mat3> half_turn_;  // from the start
  std::vector<InverseMass> middle_mass_;
  struct Changes {  // per body, over dt; of the torque for tumbling bodies
    Vec6 a = Vec6::Zero();
    Vec6 now = Vec6::Zero();
    Vec6 before = Vec6::Zero();
  };
  std::vector<Changes> changes_;
};

namespace {

// In the first sub-steps, and the first after an impact, the change is unknown.
bool changes_are_known(const Vec6& acceleration) { return !acceleration.isZero(0.0); }

// Changes of acceleration are not extrapolated to sub-steps that are longer by this factor.
constexpr double kMostGrowth = 32.0;

// dt/dt-. In the first sub-step, changes refer to a trial sub-step of the same length.
double growth_of(double dt, double time) {
  if (time == dt) return 1.0;
  const double before = 2.0 * time - dt;
  return before > 0.0 ? dt / before : 1.0;
}

// Velocity correction for a change of step length, as a factor on the change of acceleration per
// previous sub-step [s]; likewise for momentum and torque.
double step_change(double dt, double time) {
  const double before = 2.0 * time - dt;
  return before > 0.0 ? (dt * dt - before * before) / (12.0 * before) : dt / 12.0;
}

// The velocity w that moves a body's pose. `u` is the velocity after this sub-step's impulses,
// `u_before` that before its forces.
Vec6 pose_velocity(const Substep& sub, const State& state, std::size_t i, const Vec6& u) {
  const double dt = sub.dt;
  const Vec6& u_before = sub.u_before[i];
  const Vec6& acceleration = state.acceleration[i];
  const Vec6& last_change = state.acceleration_change[i];
  const double scaled =
      changes_are_known(acceleration) ? growth_of(dt, sub.impulse_time[i]) * dt : 0.0;
  const double per_time = 1.0 / sub.impulse_time[i];
  Vec6 w;
  Vec3 middle;  // angular acceleration
  for (int j = 0; j < 6; ++j) {
    const double a = per_time * (u[j] - u_before[j]);
    const double change = a - acceleration[j];
    w[j] = (u[j] - scaled / 12.0 * last_change[j]) + scaled / 6.0 * change;
    if (j < 3) continue;
    const double growth = scaled / dt;
    middle[j - 3] = a + growth * (7.0 * change - 3.0 * last_change[j]) / 8.0;
  }
  w.tail<3>() += dt * dt / 12.0 * middle.cross(w.tail<3>());
  w.tail<3>() *= half_tangent_factor(0.5 * dt * w.tail<3>());
  return w;
}

// Rotation from the carried momentum l and `torque`, extrapolated over the sub-step by its last two
// changes. Returns the angular velocity for integrate() [rad/s].
Vec3 turn_velocity(const Substep& sub, const State& state, std::size_t body, const Vec3& l,
                   const Vec3& torque) {
  const Vec3& I = sub.scene->bodies[body].inertia;
  const Mat3& R = sub.R_WB[body];
  Vec3 change = Vec3::Zero();  // per sub-step dt
  Vec3 bent = Vec3::Zero();
  if (changes_are_known(state.acceleration[body])) {
    const double growth = growth_of(sub.dt, sub.impulse_time[body]);
    const Vec3 now = growth * (torque - state.torque[body]);
    const Vec3 before = growth * state.torque_change[body];
    change = 2.0 * now - before;
    bent = now - before;
  }
  const Vec3 middle = torque + 0.5 * change - 0.125 * bent;
  const auto to_body = [&](const Vec3& v) -> Vec3 { return R.transpose() * v; };
  const Vec3 turn = free_turn(I, to_body(l), to_body(middle), to_body(change), sub.dt);
  return R * (half_tangent_factor(0.5 * turn) / sub.dt * turn);
}

// Zero in a sub-step with an impact.
Vec3 torque_of(const Substep& sub, const State& state, std::size_t body) {
  if (!sub.smooth) return Vec3::Zero();
  return (1.0 / sub.impulse_time[body]) *
         (momentum_of(sub, body, state.u[body]) - momentum_of(sub, body, sub.u_before[body]));
}

// Of the angular velocities that an impulse at the start of the sub-step adds during it; after
// turn_velocity().
double mean_time(const Substep& sub, const State& state, std::size_t body) {
  const double dt = sub.dt;
  const double time = sub.impulse_time[body];
  const double growth = changes_are_known(state.acceleration[body]) ? growth_of(dt, time) : 0.0;
  const double after_middle = (1.0 + 7.0 / 8.0 * growth) * dt / 12.0;
  return 0.5 * dt + after_middle * dt / (time + growth * dt / 6.0);
}

bool gives_forces(const Substep& sub, const Block& block) {
  return sub.has_springs && !block.is_bounded() && !is_grab(block);
}

}  // namespace

void Stormer::begin(const Substep& sub, State& state) {
  if (sub.scene->effects.gyroscopic) resize_torques(state);
  if (needs_first_changes(sub, state)) find_first_changes(sub, state);
  const bool known = !state.acceleration_change.empty();
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    const double before = state.dt_previous_of(i);
    if (before > 0.0 && sub.dt > kMostGrowth * before) forget(i, state);
    if (!known || sub.impulse_time[i] == sub.dt || state.acceleration_change[i].isZero(0.0)) {
      continue;
    }
    Vec6 correction = step_change(sub.dt, sub.impulse_time[i]) * state.acceleration_change[i];
    if (tumbles(sub, i)) correction.tail<3>().setZero();  // by its momentum, below
    state.u[i] += correction;
  }
  if (sub.settings.gyroscopic != Gyroscopic::kImplicit) return Leapfrog::begin(sub, state);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!tumbles(sub, i)) continue;
    const Mat3& R = sub.R_WB[i];
    Vec3 l = momentum_at_start(sub, state, i);
    if (sub.impulse_time[i] != sub.dt && !state.torque_change[i].isZero(0.0)) {
      l += R.transpose() * Vec3(step_change(sub.dt, sub.impulse_time[i]) * state.torque_change[i]);
    }
    state.u[i].tail<3>() = R * l.cwiseQuotient(sub.scene->bodies[i].inertia);
  }
}

void Stormer::find_first_changes(const Substep& sub, State& state) const {
  const FirstAccelerations first = first_accelerations(sub, state, joints_, *sub.solver);
  // A parabola through the three gives the change before the first of them.
  const auto change = [&](const auto& quantity, std::size_t i) {
    return (3.0 * quantity(first.at_start)[i] - 2.0 * quantity(first.before)[i] -
            quantity(first.after)[i])
        .eval();
  };
  state.acceleration.resize(state.u.size(), Vec6::Zero());
  state.acceleration_change.resize(state.u.size(), Vec6::Zero());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    state.acceleration[i] = first.before.a[i];
    state.acceleration_change[i] = change([](const Accelerations& at) { return at.a; }, i);
    if (!tumbles(sub, i)) continue;
    state.torque[i] = first.before.torque[i];
    state.torque_change[i] = change([](const Accelerations& at) { return at.torque; }, i);
  }
}

std::int64_t Stormer::aim(const Substep& sub, State& state) {
  for (const Block& block : sub.rows) {
    if (gives_forces(sub, block)) apply_impulse(block, block.given, sub.inverse_mass, state.u);
  }
  u_free_.assign(state.u.begin(), state.u.end());
  solves_in_middle_ =
      aims_at_poses(sub.settings) && knows_motion(sub) && !changes_mass(sub.settings.mode);
  return aims_at_poses(sub.settings) ? aim_at_poses(sub, state) : aim_rolling(sub, motions_);
}

void Stormer::extend(System& system, const Substep& /*sub*/, const State& /*state*/) {
  if (solves_in_middle_) system.inverse_mass = middle_mass_;
}

// Joints must hold at the end poses, and contacts that stick must not slide on the way; rows are
// linearised about poses extrapolated with the last change of acceleration: the motion w^ from u^.
std::int64_t Stormer::aim_at_poses(const Substep& sub, State& state) {
  for (auto* of_bodies : {&state.acceleration, &state.acceleration_change, &u_guess_}) {
    of_bodies->resize(state.u.size(), Vec6::Zero());
  }
  half_turn_.resize(state.u.size());
  middle_mass_.assign(sub.inverse_mass.begin(), sub.inverse_mass.end());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    u_guess_[i] = sub.u_before[i] +
                  sub.impulse_time[i] * (state.acceleration[i] + state.acceleration_change[i]);
    Vec6 w_guess = pose_velocity(sub, state, i, u_guess_[i]);
    if (tumbles(sub, i)) {
      const Vec3 torque = state.torque[i] + state.torque_change[i];
      const Vec3 l = momentum_of(sub, i, sub.u_before[i]) + sub.impulse_time[i] * torque;
      u_guess_[i].tail<3>() = velocity_of(sub, i, l);
      w_guess.tail<3>() = turn_velocity(sub, state, i, l, torque);
    }
    if (solves_in_middle_ && tumbles(sub, i)) {
      const Vec3 l = momentum_of(sub, i, u_guess_[i]);
      const Mat3& T = half_turn_[i] = motion(w_guess, mean_time(sub, state, i)).R;
      middle_mass_[i].angular = T * sub.inverse_mass[i].angular * T.transpose();
      const Vec3 gained = l - momentum_of(sub, i, u_free_[i]);
      u_guess_[i].tail<3>() = u_free_[i].tail<3>() + middle_mass_[i].angular * gained;
    }
    motions_[i] = motion(w_guess, sub.dt);
  }
  const double share = sub.dt / sub.planned_dt;  // of the gap
  std::int64_t flops = aim_flops(sub.rows, std::ssize(sub.part->moving));
  for (Block& block : sub.rows) {
    double gained[kMaxRows];
    const bool is_mean = is_drive(block) || is_armature(block);
    if (!block.is_bounded() || is_mean) {
      moved_errors(block, motions_.of(block.a), motions_.of(block.b), gained);
      if (is_mean) flops += move_flops(block, 1);
    } else if (aims_rolling(sub.settings) && sticks(block)) {
      moved_sliding(block, motions_.of(block.a), motions_.of(block.b), gained + 1);
      flops += move_flops(block, 2);
    } else {
      continue;
    }
    double speed[kMaxRows];
    row_speeds(block, u_guess_, speed);
    const double per_g = 1.0 / motion_gain(sub, state, block);
    if (block.is_contact()) {
      for (int row = 1; row < 3; ++row)
        block.bias[row] += per_g / sub.dt * gained[row] - speed[row];
      continue;
    }
    for (int row = 0; row < block.rows; ++row) {
      if (block.C[row] > 0.0 && !(block.spring_ahead[row] > 0.0)) continue;  // its force is given
      // The bias of a spring, a drive or an armature belongs to a mean over the sub-step.
      const double aimed = block.C[row] > 0.0 || is_mean
                               ? per_g * (block.bias[row] + gained[row] / sub.dt)
                               : per_g / sub.dt * (share * block.phi[row] + gained[row]);
      block.bias[row] = aimed - speed[row];
      block.softness[row] *= per_g;
    }
  }
  return flops;
}

double Stormer::motion_gain(const Substep& sub, const State& state, const Block& block) const {
  double g = 1.0;
  for (const int body : {block.a, block.b}) {
    if (body < 0 || !changes_are_known(state.acceleration[index(body)])) continue;
    const double time = sub.impulse_time[index(body)];
    g = 1.0 + growth_of(sub.dt, time) * sub.dt / (6.0 * time);
  }
  return g;
}

// In a sub-step with an impact poses move by the velocities, which it does not know yet.
bool Stormer::knows_motion(const Substep& sub) const {
  return sub.struck.empty() &&
         std::none_of(sub.rows.begin(), sub.rows.end(),
                      [](const Block& block) { return block.is_unilateral(); });
}

bool Stormer::breaks_motion(const Block& contact) const {
  if (!(contact.spring_ahead[0] > 0.0)) return Leapfrog::breaks_motion(contact);
  return (contact.impulse[0] > 0.0) != contact.was_closed;
}

void Stormer::forget(std::size_t body, State& state) const {
  if (!state.acceleration.empty()) state.acceleration[body].setZero();
  if (!state.acceleration_change.empty()) state.acceleration_change[body].setZero();
}

// What rows changed, with the inverse mass at the start instead of that of the solve.
Vec6 Stormer::velocity_at_start(const Substep& sub, std::size_t body, const Vec6& u) const {
  if (!solves_in_middle_ || !tumbles(sub, body)) return u;
  const Mat3& T = half_turn_[body];
  Vec6 out = u;
  Vec6 gained = Vec6::Zero();
  gained.tail<3>() = T.transpose() * (u.tail<3>() - u_free_[body].tail<3>());
  out.tail<3>() = u_free_[body].tail<3>() +
                  sub.inverse_mass[body].angular * (T * momentum_of(sub, body, gained));
  return out;
}

void Stormer::settle(Substep& sub, State& state) {
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    state.u[i] = velocity_at_start(sub, i, state.u[i]);
  }
  for (Block& block : sub.rows) {
    if (!gives_forces(sub, block)) continue;
    for (int row = 0; row < block.rows; ++row) block.impulse[row] += block.given[row];
  }
}

// As move_poses(). With contacts, poses are taken to move by the velocities.
void Stormer::predict_velocities(const Substep& sub, const State& state, std::span<Vec6> w) const {
  const bool known = knows_motion(sub) && !state.acceleration.empty();
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    w[i] = known ? pose_velocity(sub, state, i, state.u[i]) : state.u[i];
    if (!known || !tumbles(sub, i)) continue;
    const Vec3 l = momentum_of(sub, i, velocity_at_start(sub, i, state.u[i]));
    const Vec3 torque = (1.0 / sub.impulse_time[i]) * (l - momentum_of(sub, i, sub.u_before[i]));
    w[i].tail<3>() = turn_velocity(sub, state, i, l, torque);
  }
}

// In a sub-step with an impact poses move by the velocities.
void Stormer::move_poses(const Substep& sub, State& state) {
  for (auto* of_bodies : {&state.acceleration, &state.acceleration_change, &w_}) {
    of_bodies->resize(state.u.size(), Vec6::Zero());
  }
  changes_.resize(state.u.size());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    w_[i] = sub.smooth ? pose_velocity(sub, state, i, state.u[i]) : state.u[i];
    if (tumbles(sub, i)) {
      w_[i].tail<3>() =
          turn_velocity(sub, state, i, momentum_of(sub, i, state.u[i]), torque_of(sub, state, i));
    }
    Vec6 a = Vec6::Zero();
    if (sub.smooth) a = (1.0 / sub.impulse_time[i]) * (state.u[i] - sub.u_before[i]);
    store_changes(sub, i, a, state);
    state.acceleration[i] = a;
  }
  integrate(sub, w_, turn_momentum, state);
  settle_momentum(sub, state);
}

// begin() corrected the velocity with the change of the sub-step before last; the current one is
// now known, so the difference is added. Poses are not corrected: they satisfy the constraints.
void Stormer::store_changes(const Substep& sub, std::size_t body, const Vec6& a, State& state) {
  const double time = sub.impulse_time[body];
  const bool known = sub.smooth && changes_are_known(state.acceleration[body]);
  const double growth = known ? growth_of(sub.dt, time) : 0.0;
  const double late = known && time != sub.dt ? 1.5 * step_change(sub.dt, time) : 0.0;
  const Vec6 change = a - state.acceleration[body];
  changes_[body] = {a, growth * change, growth * state.acceleration_change[body]};
  Vec6 correction = late * (change - state.acceleration_change[body]);
  state.acceleration_change[body] = growth * change;
  if (tumbles(sub, body)) {
    const Vec3 torque = torque_of(sub, state, body);
    const Vec3 torque_change = torque - state.torque[body];
    changes_[body].a.tail<3>() = torque;
    changes_[body].now.tail<3>() = growth * torque_change;
    changes_[body].before.tail<3>() = growth * state.torque_change[body];
    correction.tail<3>() =
        velocity_of(sub, body, late * (torque_change - state.torque_change[body]));
    state.torque_change[body] = growth * torque_change;
    state.torque[body] = torque;
  }
  if (late != 0.0 && correction.allFinite()) state.u[body] += correction;
}

// Velocities are q' - dt^2/24 a' in the middle of a sub-step; from there on
//   q'+ = q' + dt (a/2 + 3/8 D + (D - D-)/3),
// with parabolic accelerations. For tumbling bodies likewise with momentum and torque.
void Stormer::synchronise(const Substep& sub, State& state) {
  if (!sub.smooth) return Leapfrog::synchronise(sub, state);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    const Changes& by = changes_[i];
    synchronise_by(sub, i, sub.dt * (0.5 * by.a + 19.0 / 24.0 * by.now - 9.0 / 24.0 * by.before),
                   state);
  }
}

std::unique_ptr<TimeIntegrator> make_stormer(const Scene& scene, const JointStage* joints) {
  return std::make_unique<Stormer>(scene, joints);
}

}  // namespace substep
