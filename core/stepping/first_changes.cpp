#include "core/stepping/first_changes.hpp"

#include <algorithm>

#include "core/constraints/grab_rows.hpp"
#include "core/math/gyroscopic.hpp"
#include "core/stepping/carried_momentum.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/gyroscopic_stage.hpp"
#include "core/stepping/integrate.hpp"

namespace substep {

namespace {

constexpr int kSolves = 5;  // at the start, and in two passes at both trial poses

/// A sub-step and a state at trial poses, and the rows there.
struct Trial {
  Substep sub;
  State state;
  Blocks blocks;
};

/// Moves the poses by time s with accelerations `a`. State::u becomes the velocity there.
Trial trial_at(const Substep& sub, const State& start, const JointStage* joints, double s,
               std::span<const Vec6> a, std::span<const Vec6> rate) {
  Trial trial{sub, start, {}};
  std::vector<Vec6> way(a.size(), Vec6::Zero());
  std::fill(trial.state.u.begin(), trial.state.u.end(), Vec6::Zero());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    way[i] = start.u[i] + 0.5 * s * a[i];
    trial.state.u[i] = start.u[i] + s * a[i] + 0.5 * s * s * rate[i];
  }
  integrate(*sub.part, s, way, trial.state);
  rotation_matrices(sub.part->moving, trial.state, trial.sub.R_WB);
  inverse_mass(sub.inertia_inverse, *sub.part, trial.sub.R_WB, trial.sub.inverse_mass);
  if (joints) joints->append(*sub.part, trial.state, trial.sub.R_WB, trial.blocks);
  trial.sub.rows = trial.blocks.all();
  return trial;
}

/// Accelerations by gyroscopic torques alone.
std::vector<Vec6> gyroscopic_accelerations(const Substep& sub, std::span<const Vec6> u) {
  std::vector<Vec6> a(u.size(), Vec6::Zero());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!tumbles(sub, i)) continue;
    const Vec3& I = sub.scene->bodies[i].inertia;
    const Vec3 omega_B = sub.R_WB[i].transpose() * u[i].tail<3>();
    a[i].tail<3>() = sub.R_WB[i] * gyroscopic_torque(I, omega_B).cwiseQuotient(I);
  }
  return a;
}

}  // namespace

Accelerations accelerations(const Substep& sub, std::span<const Vec6> u, Solver& linear) {
  const Scene& scene = *sub.scene;
  const std::size_t n = u.size();
  set_acceleration_rows(sub.rows, u, sub.inverse_mass, sub.dt, scene.regularisation);
  const std::vector<Vec6> free = gyroscopic_accelerations(sub, u);
  Accelerations out{free, std::vector<Vec3>(n, Vec3::Zero()), {}};
  apply_forces(sub, std::vector<double>(n, 1.0), out.a);
  for (const Block& block : sub.rows) apply_impulse(block, block.given, sub.inverse_mass, out.a);
  System system{sub.rows, sub.inverse_mass, out.a, free, 1.0, sub.R_WB, scene.regularisation, {}};
  system.limits = sub.limits;
  // Equal shares. A budget that is too small here is too small for the sub-step too.
  system.limits.work /= kSolves;
  if (linear.solve(system, sub.settings).status == SolveStatus::kOverLimits) out.a = free;
  for (const Block& block : sub.rows) {
    std::copy_n(block.impulse, block.rows, out.lambda.emplace_back().begin());
  }
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (tumbles(sub, i)) out.torque[i] = momentum_of(sub, i, out.a[i] - free[i]);
  }
  return out;
}

bool needs_first_changes(const Substep& sub, const State& state) {
  if (sub.probing) return false;
  const bool knows_forces = std::none_of(sub.rows.begin(), sub.rows.end(), [](const Block& block) {
    return is_grab(block) || block.is_motor() || (block.is_bounded() && block.phi[0] <= 0.0);
  });
  if (!knows_forces) return false;
  const std::vector<int>& moving = sub.part->moving;
  return std::none_of(moving.begin(), moving.end(),
                      [&](int i) { return state.dt_previous_of(index(i)) > 0.0; });
}

// Errors of the trial velocities that are even in time cancel in the first difference, but not in
// the second; a second pass with the changes of the first is third order.
FirstAccelerations first_accelerations(const Substep& sub, const State& state,
                                       const JointStage* joints, Solver& linear) {
  const double dt = sub.dt;
  std::vector<Vec6> rate(state.u.size(), Vec6::Zero());
  const auto at = [&](double s, std::span<const Vec6> a) {
    const Trial trial = trial_at(sub, state, joints, s, a, rate);
    return accelerations(trial.sub, trial.state.u, linear);
  };
  FirstAccelerations first;
  first.at_start = at(0.0, rate);
  for (int pass = 0; pass < 2; ++pass) {
    first.before = at(-dt, first.at_start.a);
    first.after = at(dt, first.at_start.a);
    for (std::size_t i = 0; i < rate.size(); ++i) {
      rate[i] = 0.5 / dt * (first.after.a[i] - first.before.a[i]);
    }
  }
  return first;
}

}  // namespace substep
