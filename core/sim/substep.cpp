// The parts of a sub-step.

#include <algorithm>
#include <cmath>

#include "core/constraints/grab_rows.hpp"
#include "core/sim/energy.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/external.hpp"
#include "core/stepping/full_stiffness.hpp"
#include "core/stepping/integrate.hpp"
#include "core/stepping/mode_rules.hpp"
#include "core/stepping/small_steps.hpp"
#include "core/stepping/stormer.hpp"

namespace substep {

namespace {

void set_softness(std::span<Block> blocks, double regularisation, double dt) {
  const double per_dt2 = 1.0 / (dt * dt);
  for (Block& block : blocks) {
    for (int row = 0; row < kMaxRows; ++row) {
      block.softness[row] = block.C[row] * per_dt2 + regularisation;
    }
  }
}

}  // namespace

void Simulator::Impl::begin_substep(FrameReport& report) {
  clock = StageClock(measures.stages);
  if (open && schedule.first_of_part()) {
    first_block = blocks.size();
    first_force = forces.size();
    state.time = static_cast<double>(state.frame) * scene->frame;
  }
  turn_axes(part().moving);
  if (needs_first_changes()) find_first_changes(schedule.dt());
  copy(state.u, u_start);
  if (open) report.n_substeps = std::max(report.n_substeps, schedule.number());
}

bool Simulator::Impl::append_rows(FrameReport& report) {
  blocks.keep(first_block);
  if (joints) {
    joints->append(part(), state, R_WB, blocks);
    clock.lap(report.times.joints);
  }
  if (contact) {
    if (!append_contacts()) {
      report.status = StepStatus::kTooManyContacts;
      report.overrun.budget = budget.contacts;
      blocks.keep(first_block);  // nothing solves them
      return false;
    }
    clock.lap(report.times.contact);
  }
  if (friction) {
    friction->append(*scene, R_WB, rows());
    clock.lap(report.times.friction);
  }
  if (holds_grab()) {
    const auto body = static_cast<std::size_t>(grab->body);
    grab_rows(*grab, {state.x[body], R_WB[body]}, blocks.append());
    clock.lap(report.times.grab);
  }
  return within_budget(report);
}

bool Simulator::Impl::append_contacts() {
  if (settings.detection == Detection::kSubstep || !open) {
    return contact->detect_and_append(*scene, part(), state, R_WB, blocks);
  }
  const double dt = schedule.dt();
  if (!contacts_predicted || !contact->prediction_valid(*scene, part(), state, dt)) {
    contacts_predicted = contact->predict(*scene, all, state, R_WB, scene->frame);
    if (!contacts_predicted) return false;
  }
  return contact->append_predicted(*scene, part(), state, R_WB, dt, blocks);
}

void Simulator::Impl::external_forces(double dt, FrameReport& report) {
  const Part& moved = part();
  for (const int body : moved.moving) {
    const auto i = static_cast<std::size_t>(body);
    impulse_time[i] = force_time(settings.integrator, state.dt_previous_of(i), dt);
  }
  if (follows_accelerations(settings)) correct_velocity_for_step_change(dt);
  if (scene->effects.gyroscopic) {
    gyroscopic_torques(dt);
    report.stages.gyroscopic = true;
  }
  copy(state.u, u_before);
  if (scene->effects.gravity) {
    for (const int body : moved.moving) {
      state.u[index(body)].head<3>() += impulse_time[index(body)] * scene->gravity;
    }
    report.stages.gravity = true;
  }
  if (scene->effects.external) {
    add_external(*scene, moved, inertia_inverse, R_WB, impulse_time, state.u);
    report.stages.external = true;
  }
  if (changes_mass(settings.mode)) {
    effective_mass(*scene, moved, settings, inertia_inverse, R_WB, u_start, dt, state,
                   inverse_mass);
    report.stages.effective_mass = true;
  } else {
    substep::inverse_mass(inertia_inverse, moved, R_WB, inverse_mass);
  }
  clock.lap(report.times.mass);
}

// Accelerations are not extrapolated across an impact. A resolved spring causes no impact, but the
// change of acceleration is unknown when its contact opens or closes.
bool Simulator::Impl::breaks_motion(const Block& touching) const {
  const bool closed = touching.impulse[0] > 0.0;
  if (follows_accelerations(settings) && touching.spring_ahead[0] > 0.0) {
    return closed != touching.was_closed;
  }
  return closed && !touching.was_closed && !(touching.spring_ahead[0] > 0.0);
}

bool Simulator::Impl::solve(double dt, FrameReport& report, bool probing) {
  const std::span<Block> own = rows();
  set_softness(own, scene->regularisation, dt);
  if (restitution && !probing && !propagate_impacts(dt, report)) return false;
  if (forces_are_stored()) seed_forces();
  if (probing) {
    set_probe_bias(own, dt);
  } else {
    set_drift_bias(own, drift_law(settings), settings.drift_tau, dt);
  }
  if (!probing) {
    if (has_springs) set_joint_springs(dt);
    if (contact && averages_contacts()) set_contact_springs(dt);
    if (settings.drift_order == 2) add_curvature_bias(own, u_start, dt);
    if (bends_rows()) bend_rows(dt);
    if (restitution) restitution->apply(*scene, u_before, dt, own);
  }
  if (follows_accelerations(settings) && !probing && drift_law(settings) == Drift::kFull) {
    aim_at_poses(dt);
    report.work.flops += stormer_flops(own, part().moving.size());
  }
  if (holds_grab()) soften_grab(*grab, dt, own.back());
  const bool gives = has_springs && follows_accelerations(settings) && !probing;
  if (gives) {
    for (const Block& block : own) {
      if (!block.is_contact()) apply_impulse(block, block.given, inverse_mass, state.u);
    }
  }
  if (extrapolates(settings)) prepare_courses();
  const System system{own,
                      inverse_mass,
                      state.u,
                      u_before,
                      dt,
                      R_WB,
                      scene->regularisation,
                      extrapolated_velocities(),
                      impulse_time,
                      momentum_inertia,
                      courses,
                      limits_of_solve(progress(report), settings, budget)};
  Settings asked = settings;
  asked.iterations = iterations_of(settings, dt / scene->frame);
  const SolveReport solved = solver->find_velocities(system, asked);
  if (solved.status == SolveStatus::kOverLimits) {
    refuse_solve(solved, dt, report);
    return false;
  }
  if (outputs_needed || probing || schedule.needs_stiffness() ||
      starts_from_last_forces(settings) || springs_are_stored()) {
    solver->find_impulses(own);
  }
  if (gives) {
    for (Block& block : own) {
      if (block.is_contact()) continue;
      for (int row = 0; row < block.rows; ++row) block.impulse[row] += block.given[row];
    }
  }
  smooth = !contact || std::none_of(own.begin(), own.end(), [&](const Block& block) {
    return block.is_contact() && breaks_motion(block);
  });
  if (restitution && restitution->struck()) smooth = false;
  if (scene->effects.gyroscopic && !probing && !carries_momentum(settings)) {
    settle_gyroscopic(dt);
  }
  count_work(solved, report);
  clock.lap(report.times.solve);
  return true;
}

void Simulator::Impl::count_work(const SolveReport& solved, FrameReport& report) {
  SolverWork& work = report.work;
  ++work.solves;
  work.rows += count_rows(rows());
  work.iterations += solved.iterations;
  work.row_updates += solved.row_updates;
  work.pivots += solved.pivots;
  work.passes += solved.passes;
  work.factorisations += solved.factorisations;
  work.flops += solved.flops;
  if (solved.status == SolveStatus::kUnsolved) ++work.unsolved;
  if (solved.status == SolveStatus::kUnsettled) ++work.unsettled;
}

// Checks the kinetic energy, which overflows long before the velocities.
bool Simulator::Impl::finite(FrameReport& report) {
  const Part& moved = part();
  double squares = 0.0;
  for (const int body : moved.bodies)  // static bodies are checked too
    squares += state.u[static_cast<std::size_t>(body)].squaredNorm();
  if (!std::isfinite(heaviest * squares)) {  // then look for a body that is too fast
    double sum = 0.0;
    for (const int body : moved.bodies) {
      const auto i = static_cast<std::size_t>(body);
      sum += most_kinetic(scene->bodies[i], state.u[i]);
      if (std::isfinite(sum)) continue;
      stop(i, report);
      return false;
    }
  }
  if (forces_are_stored()) store_forces();
  return true;
}

void Simulator::Impl::stop(std::size_t body, FrameReport& report) {
  report.status = StepStatus::kNotFinite;
  report.failed_body = static_cast<int>(body);
  copy(u_start, state.u);
}

bool Simulator::Impl::evaluate_stiffness(FrameReport& report) {
  if (!stiffness) stiffness = std::make_unique<StiffnessStage>(*scene);
  for (Block& block : rows()) find_lambda(block, block.lambda);
  const bool full = rules_of(settings.mode).mass == StiffMass::kFull;
  const ContactTerms terms = full ? ContactTerms::kNormal
                             : settings.contact_stiffness == ContactStiffness::kExact
                                 ? ContactTerms::kExact
                                 : ContactTerms::kPaper;
  stiffness->evaluate(rows(), terms, part(), R_WB, state.k);
  if (full) {  // bodies outside the part keep their values, as in k
    state.K_resisting.resize(state.k.size(), Mat3::Zero());
    for (const int body : part().bodies) {
      state.K_resisting[static_cast<std::size_t>(body)] =
          resisting(stiffness->matrix().angular(body));
    }
  } else {
    state.K_resisting.clear();
  }
  bound = StiffnessStage::bound(*scene, part().bodies, state.k);
  // In a diverging run K can overflow before the velocities.
  for (const int body : part().bodies) {
    const auto i = static_cast<std::size_t>(body);
    if (state.k[i].allFinite() && (!full || state.K_resisting[i].allFinite())) continue;
    stop(i, report);
    state.k.clear();
    state.K_resisting.clear();
    return false;
  }
  remember_stiffness();
  ++report.criterion.evaluations;
  report.criterion.flops += stiffness->flops(rows(), terms);
  report.stages.stiffness = true;
  clock.lap(report.times.stiffness);
  return true;
}

// r per body, because islands merge and split.
void Simulator::Impl::remember_stiffness() {
  if (state.own.empty()) return;
  for (const int body : part().bodies) {
    double& r = state.own[static_cast<std::size_t>(body)].r;
    r = remembered(settings, StiffnessStage::bound(*scene, {&body, 1}, state.k).r, r);
  }
}

void Simulator::Impl::advance_poses(double dt, FrameReport& report) {
  const std::span<const Vec6> move_by = pose_velocities(dt);
  store_accelerations(dt);
  integrate(part(), dt, move_by, state);
  if (scene->effects.gyroscopic && carries_momentum(settings)) settle_momentum(dt);
  if (outputs_needed) synchronise(dt);
  state.time += dt;
  state.dt_previous = dt;
  if (!state.own.empty()) {
    for (const int body : part().bodies) state.own[static_cast<std::size_t>(body)].dt_previous = dt;
    if (!looks_for_islands(settings)) state.own.clear();  // all bodies share one clock
  }
  substeps_of_bodies += static_cast<std::int64_t>(part().moving.size());
  report.dt_min = report.dt_min == 0.0 ? dt : std::min(report.dt_min, dt);
  report.dt_max = std::max(report.dt_max, dt);
  clock.lap(report.times.integrate);
}

void Simulator::Impl::find_lambda(const Block& block, double* lambda) const {
  const double time = impulse_time_of(block);
  for (int row = 0; row < block.rows; ++row) lambda[row] = block.impulse[row] / time;
}

// Bodies that have just made contact may differ in it; the force between them is then nominal.
double Simulator::Impl::impulse_time_of(const Block& block) const {
  const double a = block.a < 0 ? 0.0 : impulse_time[static_cast<std::size_t>(block.a)];
  const double b = block.b < 0 ? 0.0 : impulse_time[static_cast<std::size_t>(block.b)];
  return std::max(a, b);
}

}  // namespace substep
