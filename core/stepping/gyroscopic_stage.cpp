#include "core/stepping/gyroscopic_stage.hpp"

#include <algorithm>

#include "core/constraints/grab_rows.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/math/gyroscopic.hpp"

namespace substep {

namespace {

// Largest rotation per sub-step for which the torque is predicted [rad]. The prediction error feeds
// back into the next torque, in proportion to the rotation. For larger rotations the torque is
// taken as zero, which is stable and first order.
constexpr double kMaxPredictedTurn = 0.2;

bool is_zero(const Vec3& v) { return v.isZero(0.0); }

// True unless a body rotates about a principal axis, as in planar motion, but for rounding or a
// disturbance of that size. A body that does not rotate has no axis, only the rounding of one.
bool leaves_axis(const Vec3& I, const Vec3& omega_B, double dt) {
  constexpr double kTurn = 1e-9;   // in the sub-step, whose square is below rounding [rad]
  constexpr double kAngle = 1e-6;  // from the axis [rad]
  if (!(dt * omega_B.norm() > kTurn)) return false;
  const double most = kAngle * omega_B.norm() * I.cwiseProduct(omega_B).norm();
  return gyroscopic_torque(I, omega_B).norm() > most;
}

// A sub-step is solved with the gradients at its start, which leaves an error dt^2/2 phi''. In
// planar motion this is a constant offset along the joint's arm. In 3D the force acts at that
// offset from the joint, and angular momentum and energy drift. The rows are therefore set up at
// the predicted poses ("bent"):
//   phi + (r_a^ - r_a) - (r_b^ - r_b) + dt (J u+ - J_omega omega^) = 0,
// and likewise for a hinge. Centres move linearly and drop out. Impacts cannot be predicted: where
// they happen within sub-steps, in scenes with contacts that are not found along the motion, joints
// use plain Eq. 3. Rigid joints that are closed exactly hold at the end poses either way.
bool bends_rows(const Substep& sub) {
  const Settings& settings = sub.settings;
  const bool with_contacts = settings.detection == Detection::kContinuous &&
                             (drift_law(settings) != Drift::kExact || sub.has_springs);
  return settings.gyroscopic == Gyroscopic::kImplicit && sub.scene->effects.joints &&
         (!sub.scene->effects.contact || with_contacts) && settings.drift_order == 1 &&
         !entry_of(settings.solver).at_end;
}

// In a loop either all rows are bent or none: in an overconstrained mechanism, bent and unbent rows
// contradict each other by dt/2 phi''. Bodies rotating about a principal axis are then predicted
// like the others. True if the part has more joints than bodies.
bool closes_loops(const Substep& sub) {
  const auto joined = std::count_if(sub.rows.begin(), sub.rows.end(), [](const Block& block) {
    return !block.is_bounded() && !is_grab(block);
  });
  return joined > std::ssize(sub.part->moving);
}

bool any_leaves_axis(const Substep& sub, const State& state) {
  const std::vector<int>& moving = sub.part->moving;
  return std::any_of(moving.begin(), moving.end(), [&](int body) {
    const std::size_t i = index(body);
    if (!tumbles(sub, i)) return false;
    const Vec3 omega_B = sub.R_WB[i].transpose() * state.u[i].tail<3>();
    return leaves_axis(sub.scene->bodies[i].inertia, omega_B, sub.dt);
  });
}

// The force acts on both bodies at one point, the static anchor or the midpoint, for any gap:
// angular momentum is then conserved to rounding. The rows measure the speed of that point.
void meet(Block& block) {
  const Vec3 gap{block.phi[0], block.phi[1], block.phi[2]};
  if (block.a >= 0) block.r_a -= (block.b >= 0 ? 0.5 : 1.0) * gap;
  if (block.b >= 0) block.r_b += (block.a >= 0 ? 0.5 : 1.0) * gap;
}

}  // namespace

bool turns_otherwise(const Substep& sub, std::size_t body) {
  return sub.scene->effects.gyroscopic && !sub.inertia_inverse[body].isotropic;
}

bool tumbles(const Substep& sub, std::size_t body) {
  return turns_otherwise(sub, body) && sub.settings.gyroscopic == Gyroscopic::kImplicit;
}

void resize_torques(State& state) {
  state.torque.resize(state.u.size(), Vec3::Zero());
  state.torque_change.resize(state.u.size(), Vec3::Zero());
}

void GyroscopicStage::begin(const Substep& sub, State& state) {
  if (sub.settings.gyroscopic == Gyroscopic::kImplicit) {
    resize_torques(state);
    spins_.resize(state.u.size());
    const bool damps =
        sub.settings.solver == SolverKind::kNewton && sub.settings.forces == Forces::kEnd;
    loops_bend_ = bends_rows(sub) && closes_loops(sub) && any_leaves_axis(sub, state);
    for (const int body : sub.part->moving) {
      if (tumbles(sub, index(body))) predict(sub, index(body), damps, state);
    }
    return;
  }
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!turns_otherwise(sub, i)) continue;
    const Vec3 omega_B = sub.R_WB[i].transpose() * state.u[i].tail<3>();
    state.u[i].tail<3>() = sub.R_WB[i] * gyroscopic_explicit(sub.scene->bodies[i].inertia, omega_B,
                                                             sub.impulse_time[i]);
  }
}

void GyroscopicStage::predict(const Substep& sub, std::size_t i, bool damps, State& state) {
  const Vec3& I = sub.scene->bodies[i].inertia;
  const Mat3& R = sub.R_WB[i];
  Spin& spin = spins_[i];
  const Vec3 omega_B = R.transpose() * state.u[i].tail<3>();
  spin = Spin{};
  spin.momentum = I.cwiseProduct(omega_B);
  spin.omega = spin.before = state.u[i].tail<3>();
  if (!is_zero(gyroscopic_torque(I, omega_B)) || loops_bend_) {
    spin.out_of_axis = true;
    spin.bends = loops_bend_ || leaves_axis(I, omega_B, sub.dt);
    spin.damped = damps || sub.dt * state.u[i].tail<3>().norm() > kMaxPredictedTurn ||
                  changes_mass_of(i, *sub.scene, sub.settings, state, sub.dt);
    spin.momentum = momentum_after(I, omega_B, state.dt_previous_of(i));
    if (!spin.damped) spin.push = sub.impulse_time[i] * (R.transpose() * state.torque[i]);
    aim(sub, i, omega_B + spin.push.cwiseQuotient(I));
  }
  spin.unstruck = spin.before;
  state.u[i].tail<3>() = spin.before;
}

// From the momentum at the start of the sub-step.
void GyroscopicStage::aim(const Substep& sub, std::size_t i, const Vec3& guess) {
  const Vec3& I = sub.scene->bodies[i].inertia;
  Spin& spin = spins_[i];
  const Vec3 p = spin.momentum + spin.struck;
  const Vec3 then = velocity_of_momentum(I, p + spin.push, sub.dt, guess);
  spin.predicted = 0.5 * sub.dt * gyroscopic_torque(I, then);
  spin.omega = sub.R_WB[i] * then;
  spin.before = sub.R_WB[i] * (spin.damped ? then : Vec3((p + spin.predicted).cwiseQuotient(I)));
}

void GyroscopicStage::begin_solve(const Substep& sub) {
  for (const int body : sub.part->moving) {
    Spin& spin = spins_[index(body)];
    spin.struck.setZero();
    spin.before = spin.unstruck;
  }
}

Vec3 GyroscopicStage::spin_at_start(const Substep& sub, std::size_t i) const {
  const Vec3& I = sub.scene->bodies[i].inertia;
  return sub.R_WB[i] * spins_[i].momentum.cwiseQuotient(I);
}

Vec3 GyroscopicStage::strike(const Substep& sub, std::size_t i, const Vec3& spin_at_start) {
  const Vec3& I = sub.scene->bodies[i].inertia;
  Spin& spin = spins_[i];
  const Vec3 spin_B = sub.R_WB[i].transpose() * spin_at_start;
  spin.struck = I.cwiseProduct(spin_B) - spin.momentum;
  if (is_zero(spin.struck)) return spin.before;
  spin.out_of_axis = true;
  spin.bends = leaves_axis(I, spin_B, sub.dt);
  aim(sub, i, spin_B);
  return spin.before;
}

void GyroscopicStage::keep_strikes(const Substep& sub) {
  for (const int body : sub.part->moving) {
    Spin& spin = spins_[index(body)];
    spin.momentum += spin.struck;
    spin.struck.setZero();
    spin.unstruck = spin.before;
  }
}

void GyroscopicStage::bend_rows(const Substep& sub) const {
  if (!bends_rows(sub)) return;
  const double dt = sub.dt;
  const auto turns = [&](int body) { return body >= 0 && spins_[index(body)].bends; };
  const auto predicted_turn = [&](int body) {
    Vec6 u = Vec6::Zero();
    if (body >= 0) {
      const std::size_t i = index(body);
      u.tail<3>() = turns(body) ? spins_[i].omega : Vec3(sub.u_before[i].tail<3>());
    }
    return u;
  };
  for (Block& block : sub.rows) {
    if (block.is_bounded() || is_grab(block) || !(turns(block.a) || turns(block.b))) continue;
    const Vec6 u_a = predicted_turn(block.a);
    const Vec6 u_b = predicted_turn(block.b);
    if (dt * std::max(u_a.tail<3>().norm(), u_b.tail<3>().norm()) > kMaxPredictedTurn) continue;
    double bent[kMaxRows];
    double speed[kMaxRows];
    moved_errors(block, motion(u_a, dt), motion(u_b, dt), bent);
    const bool stretches = block.C[0] > 0.0;
    if (block.has_point_rows && stretches) meet(block);
    row_speeds(block, block.a >= 0 ? &u_a : nullptr, block.b >= 0 ? &u_b : nullptr, speed);
    for (int row = 0; row < block.rows; ++row) block.bias[row] += bent[row] / dt - speed[row];
    if (block.has_point_rows && !stretches) meet(block);
  }
}

std::optional<Vec3> GyroscopicStage::pushed(const Substep& sub, std::size_t i,
                                            const Vec3& omega) const {
  if (!tumbles(sub, i) || spins_[i].damped) return std::nullopt;
  const Vec3& I = sub.scene->bodies[i].inertia;
  const Vec3 omega_B = sub.R_WB[i].transpose() * omega;
  const bool turns_freely = is_zero(gyroscopic_torque(I, omega_B)) && is_zero(spins_[i].predicted);
  if (turns_freely && !loops_bend_) return std::nullopt;
  return I.cwiseProduct(sub.R_WB[i].transpose() * (omega - spins_[i].before));
}

// From the stored momentum: rotating it back and forth would lose a digit every thousand steps.
Vec3 GyroscopicStage::settled(const Substep& sub, std::size_t i, const Vec3& omega,
                              const Vec3& pushed) const {
  const Mat3& R = sub.R_WB[i];
  const Spin& spin = spins_[i];
  return R * velocity_of_momentum(sub.scene->bodies[i].inertia,
                                  spin.momentum + spin.struck + pushed, sub.dt,
                                  R.transpose() * omega);
}

Vec3 GyroscopicStage::settled(const Substep& sub, std::size_t i, const Vec3& omega) const {
  const std::optional<Vec3> impulse = pushed(sub, i, omega);
  return impulse ? settled(sub, i, omega, *impulse) : omega;
}

void GyroscopicStage::settle(Substep& sub, State& state) const {
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!tumbles(sub, i)) continue;
    state.torque[i].setZero();
    state.torque_change[i].setZero();
    auto omega = state.u[i].tail<3>();
    const std::optional<Vec3> impulse = pushed(sub, i, omega);
    if (!impulse) continue;
    if (sub.smooth) {
      state.torque[i] = sub.R_WB[i] * (1.0 / sub.impulse_time[i] * *impulse);
    }
    const Vec3 exact = settled(sub, i, omega, *impulse);
    sub.u_before[i].tail<3>() += exact - omega;  // keeps the impulse unchanged
    omega = exact;
  }
}

}  // namespace substep
