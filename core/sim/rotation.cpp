// Tumbling of bodies with unequal moments of inertia: torques change their angular momentum, which
// determines their rotation (math/gyroscopic.hpp, free_turn.hpp).

#include <algorithm>

#include "core/constraints/grab_rows.hpp"
#include "core/math/free_turn.hpp"
#include "core/math/gyroscopic.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/stormer.hpp"

namespace substep {

namespace {

// Largest rotation per sub-step for which the torque is predicted [rad]. The prediction error feeds
// back into the next torque, in proportion to the rotation. For larger rotations the torque is
// taken as zero, which is stable and first order.
constexpr double kMaxPredictedTurn = 0.2;

bool is_zero(const Vec3& v) { return v.isZero(0.0); }

}  // namespace

bool Simulator::Impl::turns_otherwise(std::size_t body) const {
  return scene->effects.gyroscopic && !inertia_inverse[body].isotropic;
}

bool Simulator::Impl::tumbles(std::size_t body) const {
  return turns_otherwise(body) && settings.gyroscopic == Gyroscopic::kImplicit;
}

void Simulator::Impl::gyroscopic_torques(double dt) {
  if (settings.gyroscopic == Gyroscopic::kImplicit) {
    return carries_momentum(settings) ? carry_momentum(dt) : predict_gyroscopic(dt);
  }
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (!turns_otherwise(i)) continue;
    const Vec3 omega_B = R_WB[i].transpose() * state.u[i].tail<3>();
    state.u[i].tail<3>() =
        R_WB[i] * gyroscopic_explicit(scene->bodies[i].inertia, omega_B, impulse_time[i]);
  }
}

void Simulator::Impl::resize_torques() {
  state.torque.resize(state.u.size(), Vec3::Zero());
  state.torque_change.resize(state.u.size(), Vec3::Zero());
  spins.resize(state.u.size());
}

// The solver assumes M u+ = M u* + J^T impulse, while the angular momentum p at the start of the
// sub-step obeys p + J^T impulse = I u+ - dt/2 (I u+) x u+. The gyroscopic term on the right is
// predicted with the torque of the previous sub-step; settle_gyroscopic() then solves for u+ with
// the exact momentum. The correction is O(dt^3); the joint error of the same order is removed by
// the drift correction. No torque is predicted if a mode replaces the mass, if Newton uses forces
// at the end of the sub-step, or if the rotation is large: these cases are first order anyway.
void Simulator::Impl::predict_gyroscopic(double dt) {
  resize_torques();
  const bool damps = settings.solver == SolverKind::kNewton && settings.forces == Forces::kEnd;
  loops_bend = bends_rows() && closes_loops() && any_out_of_axis();
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (!tumbles(i)) continue;
    const Vec3& I = scene->bodies[i].inertia;
    const Mat3& R = R_WB[i];
    Spin& spin = spins[i];
    const Vec3 omega_B = R.transpose() * state.u[i].tail<3>();
    spin = {I.cwiseProduct(omega_B), Vec3::Zero(), state.u[i].tail<3>(), false, false};
    if (is_zero(gyroscopic_torque(I, omega_B)) && !loops_bend) continue;  // about a principal axis
    spin.momentum = momentum_after(I, omega_B, state.dt_previous_of(i));
    spin.damped = damps || dt * state.u[i].tail<3>().norm() > kMaxPredictedTurn ||
                  changes_mass_of(i, *scene, settings, state, dt);
    Vec3 pushed = Vec3::Zero();
    if (!spin.damped) {
      pushed = impulse_time[i] * (R.transpose() * state.torque[i]);
    }
    const Vec3 guess = omega_B + pushed.cwiseQuotient(I);
    const Vec3 then = velocity_of_momentum(I, spin.momentum + pushed, dt, guess);
    spin.predicted = 0.5 * dt * gyroscopic_torque(I, then);
    spin.omega = R * then;
    spin.out_of_axis = true;
    state.u[i].tail<3>() =
        R * (spin.damped ? then : Vec3((spin.momentum + spin.predicted).cwiseQuotient(I)));
  }
}

// A sub-step is solved with the gradients at its start, which leaves an error dt^2/2 phi''. In
// planar motion this is a constant offset along the joint's arm. In 3D the force acts at that
// offset from the joint, and angular momentum and energy drift. The rows are therefore set up at
// the predicted poses:
//   phi + (r_a^ - r_a) - (r_b^ - r_b) + dt (J u+ - J_omega omega^) = 0,
// and likewise for a hinge. Centres move linearly and drop out. Impacts cannot be predicted: in
// scenes with contacts joints use plain Eq. 3.
bool Simulator::Impl::bends_rows() const {
  const bool looks_ahead = settings.solver == SolverKind::kNewton ||
                           settings.solver == SolverKind::kXpbd || follows_accelerations(settings);
  return scene->effects.gyroscopic && settings.gyroscopic == Gyroscopic::kImplicit && joints &&
         !contact && settings.drift_order == 1 && !looks_ahead;
}

// In a loop either all rows are bent or none: in an overconstrained mechanism, bent and unbent rows
// contradict each other by dt/2 phi''. Bodies rotating about a principal axis are then predicted
// like the others.
bool Simulator::Impl::closes_loops() {
  const auto joined = std::count_if(rows().begin(), rows().end(), [](const Block& block) {
    return !block.is_contact() && !is_grab(block);
  });
  return joined > std::ssize(part().moving);
}

bool Simulator::Impl::any_out_of_axis() const {
  const std::vector<int>& moving = part().moving;
  return std::any_of(moving.begin(), moving.end(), [&](int body) {
    const auto i = static_cast<std::size_t>(body);
    if (!tumbles(i)) return false;
    const Vec3 omega_B = R_WB[i].transpose() * state.u[i].tail<3>();
    return !is_zero(gyroscopic_torque(scene->bodies[i].inertia, omega_B));
  });
}

void Simulator::Impl::bend_rows(double dt) {
  const auto turns = [&](int body) { return body >= 0 && spins[index(body)].out_of_axis; };
  const auto predicted_turn = [&](int body) {
    Vec6 u = Vec6::Zero();
    if (body >= 0) {
      const std::size_t i = index(body);
      u.tail<3>() = turns(body) ? spins[i].omega : Vec3(u_before[i].tail<3>());
    }
    return u;
  };
  for (Block& block : rows()) {
    if (block.is_contact() || is_grab(block) || !(turns(block.a) || turns(block.b))) continue;
    const Vec6 u_a = predicted_turn(block.a);
    const Vec6 u_b = predicted_turn(block.b);
    if (dt * std::max(u_a.tail<3>().norm(), u_b.tail<3>().norm()) > kMaxPredictedTurn) continue;
    double bent[kMaxRows];
    double speed[kMaxRows];
    moved_errors(block, motion(u_a, dt), motion(u_b, dt), bent);
    row_speeds(block, block.a >= 0 ? &u_a : nullptr, block.b >= 0 ? &u_b : nullptr, speed);
    for (int row = 0; row < block.rows; ++row) block.bias[row] += bent[row] / dt - speed[row];
    if (block.has_point_rows) meet(block);
  }
}

// The force acts on both bodies at one point, the static anchor or the midpoint, whatever the gap:
// angular momentum is then conserved to rounding.
void Simulator::Impl::meet(Block& block) {
  const Vec3 gap{block.phi[0], block.phi[1], block.phi[2]};
  if (block.a >= 0) block.r_a -= (block.b >= 0 ? 0.5 : 1.0) * gap;
  if (block.b >= 0) block.r_b += (block.a >= 0 ? 0.5 : 1.0) * gap;
}

void Simulator::Impl::settle_gyroscopic(double dt) {
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (!tumbles(i)) continue;
    const Vec3& I = scene->bodies[i].inertia;
    const Mat3& R = R_WB[i];
    const Spin& spin = spins[i];
    auto omega = state.u[i].tail<3>();
    const Vec3 omega_B = R.transpose() * omega;
    state.torque[i].setZero();
    state.torque_change[i].setZero();
    if (spin.damped) continue;
    const bool turns_freely = is_zero(gyroscopic_torque(I, omega_B)) && is_zero(spin.predicted);
    if (turns_freely && !loops_bend) continue;
    // From the stored momentum: rotating it back and forth would lose a digit every thousand steps.
    const Vec3 pushed = I.cwiseProduct(R.transpose() * (omega - u_before[i].tail<3>()));
    if (smooth) {
      state.torque[i] = R * (1.0 / impulse_time[i] * pushed);
    }
    const Vec3 settled = R * velocity_of_momentum(I, spin.momentum + pushed, dt, omega_B);
    u_before[i].tail<3>() += settled - omega;  // keeps the impulse unchanged
    omega = settled;
  }
}

// Fourth-order sub-steps solve for the momentum l: u of tumbling bodies is I^-1 l until
// settle_momentum().
void Simulator::Impl::carry_momentum(double dt) {
  resize_torques();
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (!tumbles(i)) continue;
    const Vec3& I = scene->bodies[i].inertia;
    const Mat3& R = R_WB[i];
    Vec3 l = momentum_after(I, R.transpose() * state.u[i].tail<3>(), state.dt_previous_of(i));
    if (follows_accelerations(settings) && impulse_time[i] != dt &&
        !is_zero(state.torque_change[i])) {
      l += R.transpose() * Vec3(stormer_step_change(dt, impulse_time[i]) * state.torque_change[i]);
    }
    state.u[i].tail<3>() = R * l.cwiseQuotient(I);
  }
}

void Simulator::Impl::settle_momentum(double dt) {
  for (const int body : part().moving) {
    const auto i = static_cast<std::size_t>(body);
    if (!tumbles(i)) continue;
    const Quat to_body = state.q[i].conjugate();
    const Vec3 l = to_body * momentum_of(i, state.u[i]);
    const Vec3 guess = to_body * Vec3(state.u[i].tail<3>());
    const Vec3 omega = state.q[i] * velocity_of_momentum(scene->bodies[i].inertia, l, -dt, guess);
    if (omega.allFinite()) state.u[i].tail<3>() = omega;
  }
}

Vec3 Simulator::Impl::torque_of(std::size_t body) const {
  return (1.0 / impulse_time[body]) *
         (momentum_of(body, state.u[body]) - momentum_of(body, u_before[body]));
}

Vec3 Simulator::Impl::velocity_of(std::size_t body, const Vec3& l) const {
  const Mat3& R = R_WB[body];
  return R * (R.transpose() * l).cwiseQuotient(scene->bodies[body].inertia);
}

Vec3 Simulator::Impl::momentum_of(std::size_t body, const Vec6& u) const {
  const Mat3& R = R_WB[body];
  return R * scene->bodies[body].inertia.cwiseProduct(R.transpose() * u.tail<3>());
}

// Rotation from the carried momentum l and `torque`, extrapolated over the sub-step by its last two
// changes. @return angular velocity for integrate() [rad/s]
Vec3 Simulator::Impl::turn_velocity(std::size_t body, const Vec3& l, const Vec3& torque,
                                    double dt) const {
  const Vec3& I = scene->bodies[body].inertia;
  const Mat3& R = R_WB[body];
  Vec3 change = Vec3::Zero();  // per sub-step dt
  Vec3 bent = Vec3::Zero();
  if (!state.acceleration[body].isZero(0.0)) {  // else the change is unknown
    const double growth = stormer_growth(dt, impulse_time[body]);
    const Vec3 now = growth * (torque - state.torque[body]);
    const Vec3 before = growth * state.torque_change[body];
    change = 2.0 * now - before;
    bent = now - before;
  }
  const Vec3 middle = torque + 0.5 * change - 0.125 * bent;
  const auto to_body = [&](const Vec3& v) -> Vec3 { return R.transpose() * v; };
  const Vec3 turn = free_turn(I, to_body(l), to_body(middle), to_body(change), dt);
  return R * (half_tangent_factor(0.5 * turn) / dt * turn);
}

}  // namespace substep
