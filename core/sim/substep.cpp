// The parts of a sub-step.

#include <algorithm>
#include <cmath>

#include "core/constraints/grab_rows.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/solver/cost_model.hpp"
#include "core/stepping/armature.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/drive.hpp"
#include "core/stepping/full_stiffness.hpp"
#include "core/stepping/integrate.hpp"
#include "core/stepping/stored_forces.hpp"

namespace substep {

Substep& Simulator::Impl::begin_substep(bool last_of_share, FrameReport& report) {
  clock = StageClock(measures.stages);
  if (schedule.clock().taken() == 0) {
    first_block = blocks.size();
    first_force = forces.size();
    state.time = static_cast<double>(state.frame) * scene->frame;
  }
  current.integrator = integrator.get();
  current.solver = solver.get();
  current.settings = settings;
  current.part = &schedule.part();
  current.dt = schedule.clock().dt();
  current.planned_dt = schedule.clock().planned_dt();
  current.outputs_needed = last_of_share || schedule.clock().left() == 1;
  rotation_matrices(current.part->moving, state, current.R_WB);
  copy_of(current.part->bodies, state.u, current.u_start);
  report.n_substeps = std::max(report.n_substeps, schedule.clock().taken() + 1);
  static_cast<Effects&>(report.stages) = scene->effects;
  return current;
}

bool Simulator::Impl::append_rows(Substep& sub, FrameReport& report) {
  blocks.keep(first_block);
  if (joints) {
    joints->append(*sub.part, state, sub.R_WB, blocks);
    if (coordinates) {
      coordinates->append(*sub.part, state, sub.R_WB, sub.dt, sweeps_motion(sub), blocks);
    }
    clock.lap(report.times.joints);
  }
  if (contact) {
    if (!append_contacts(sub)) {
      report.status = StepStatus::kTooManyContacts;
      report.overrun.budget = budget.contacts;
      drop_rows(sub);  // nothing solves them
      return false;
    }
    clock.lap(report.times.contact);
  }
  if (friction) {
    friction->append(*scene, sub.R_WB, blocks.from(first_block));
    clock.lap(report.times.friction);
  }
  if (holds_grab(sub)) {
    const std::size_t body = index(grab->body);
    grab_rows(*grab, {state.x[body], sub.R_WB[body]}, blocks.append());
    clock.lap(report.times.grab);
  }
  sub.rows = blocks.from(first_block);
  return within_budget(sub, report);
}

void Simulator::Impl::drop_rows(Substep& sub) {
  blocks.keep(first_block);
  sub.rows = {};
}

bool Simulator::Impl::append_contacts(const Substep& sub) {
  if (settings.detection == Detection::kContinuous) {
    return contact->append_touching(*scene, *sub.part, state, sub.R_WB, sub.dt, blocks);
  }
  if (settings.detection == Detection::kSubstep || sub.probing) {
    return contact->detect_and_append(*scene, *sub.part, state, sub.R_WB, blocks);
  }
  if (!contacts_predicted || !contact->prediction_valid(*scene, *sub.part, state, sub.dt)) {
    contacts_predicted = contact->predict(*scene, all, state, sub.R_WB, scene->frame);
    if (!contacts_predicted) return false;
  }
  return contact->append_predicted(*scene, *sub.part, state, sub.R_WB, sub.dt, blocks);
}

void Simulator::Impl::external_forces(Substep& sub, FrameReport& report) {
  const Part& moved = *sub.part;
  for (const int body : moved.moving) {
    const std::size_t i = index(body);
    sub.dt_before[i] = state.dt_previous_of(i);
    sub.impulse_time[i] = sub.integrator->force_time(sub.dt_before[i], sub.dt);
  }
  sub.integrator->begin(sub, state);
  copy(state.u, sub.u_before);
  if (!sub.u_unstruck.empty()) copy(state.u, sub.u_unstruck);
  apply_forces(sub, sub.impulse_time, state.u);
  if (changes_mass(sub.settings.mode)) {
    effective_mass(*scene, moved, sub.settings, sub.inertia_inverse, sub.R_WB, sub.u_start, sub.dt,
                   state, sub.inverse_mass);
    report.stages.effective_mass = true;
  } else {
    inverse_mass(sub.inertia_inverse, moved, sub.R_WB, sub.inverse_mass);
  }
  clock.lap(report.times.mass);
}

bool Simulator::Impl::solve(Substep& sub, FrameReport& report) {
  sub.shift = sub.gain = {};
  sub.solved = 0;
  begins_with_impact = false;
  if (!sub.drives_on.empty()) sum_drives(sub);
  if (!(sweeps_motion(sub) ? solve_until_impact(sub, report) : solve_rows(sub, report))) {
    return false;
  }
  if (sub.outputs_needed || sub.probing || schedule.clock().needs_stiffness() ||
      starts_from_last_forces(sub.settings) || springs_are_stored(sub)) {
    report.work.flops += solver->find_impulses(sub.rows);
  }
  sub.smooth =
      sub.struck.empty() &&
      (!unilateral() || std::none_of(sub.rows.begin(), sub.rows.end(), [&](const Block& block) {
        return block.is_unilateral() &&
               (sub.integrator->breaks_motion(block) || ends_impact(sub, block));
      }));
  if (!sub.probing) sub.integrator->settle(sub, state);
  clock.lap(report.times.solve);
  return true;
}

void Simulator::Impl::set_softness(const Substep& sub, std::span<Block> rows) const {
  const double per_dt2 = 1.0 / (sub.dt * sub.dt);
  for (Block& block : rows) {
    for (int row = 0; row < kMaxRows; ++row) {
      block.softness[row] = block.C[row] * per_dt2 + scene->regularisation;
    }
  }
  if (sweeps_motion(sub)) stiffen_contacts(sub, contact_softness, rows);
}

bool Simulator::Impl::solve_rows(Substep& sub, FrameReport& report) {
  set_softness(sub, sub.rows);
  if (!propagate_impacts(sub, report)) return false;
  if (sweeps_motion(sub) && !sub.struck.empty()) copy(state.u, u_rebounding);
  if (forces_are_stored(sub)) seed(sub);
  if (begins_with_impact) close_struck(sub);
  set_bias(sub, report);
  if (holds_grab(sub)) {  // contacts and limits found along the motion follow its rows
    soften_grab(*grab, sub.dt, *std::find_if(sub.rows.begin(), sub.rows.end(), is_grab));
  }
  System system{sub.rows, sub.inverse_mass,     state.u, sub.u_before, sub.dt,
                sub.R_WB, scene->regularisation};
  system.force_time = sub.impulse_time;
  system.limits = limits_of_solve(sub, report);
  system.contacts_yield = sweeps_motion(sub);
  const bool is_struck = begins_with_impact || !sub.struck.empty();
  system.u_sliding = is_struck ? sub.u_before : sub.integrator->velocities_at_start(sub);
  sub.integrator->extend(system, sub, state);
  system.frame_share = sub.dt / scene->frame;
  const bool closes = !sub.probing && closes_joints(sub);
  joints_open = false;
  if (closes) copy(state.u, u_star);
  SolveReport solved = solver->find_velocities(system, sub.settings);
  if (closes) close_joints(sub, system, *solver, solved);
  if (solved.status == SolveStatus::kOverLimits) {
    refuse_solve(sub, solved, report);
    return false;
  }
  count_work(sub, solved, report);
  last_solve = solved.status;
  return true;
}

// By the forces of the last sub-step of the part.
void Simulator::Impl::seed(const Substep& sub) {
  if (sub.probing || schedule.clock().taken() == 0) {
    seed_forces(sub, state, state.forces, index_of_last_frame);
  } else {
    seed_forces(sub, state, std::span(forces).subspan(first_force), index_of_part);
  }
}

void Simulator::Impl::set_bias(Substep& sub, FrameReport& report) {
  if (sub.probing) {
    set_probe_bias(sub.rows, sub.dt);
    return drive_motors(sub, sub.u_start);
  }
  set_drift_bias(sub.rows, drift_law(sub.settings), sub.settings.drift_tau, sub.dt, sub.planned_dt);
  if (sweeps_motion(sub)) {
    set_swept_bias(sub.rows, sub.gain, sub.shift, sub.dt, sub.planned_dt,
                   [this](const Block& block) { return is_deep(block); });
  }
  set_springs(sub, state);
  if (sub.settings.drift_order == 2) add_curvature_bias(sub.rows, sub.u_start, sub.dt);
  if (restitution && separates) restitution->apply(sub, sub.u_before, sub.rows);
  const bool is_struck = begins_with_impact || !sub.struck.empty();
  drive_motors(sub, is_struck ? sub.u_before : sub.u_start);
  report.work.flops += sub.integrator->aim(sub, state);
}

void Simulator::Impl::drive_motors(const Substep& sub, std::span<const Vec6> u) const {
  if (!coordinates) return;
  for (Block& block : sub.rows) {
    if (!block.is_motor()) continue;
    if (is_drive(block)) {
      set_drive(sub, state, coordinates->drive(block), u, block);
    } else if (is_armature(block)) {
      set_armature(sub, u, block);
    } else if (is_joint_friction(block)) {
      set_joint_friction(sub, coordinates->friction(block), impulse_time_of(sub, block), block);
    } else {
      set_motor(block, impulse_time_of(sub, block));
    }
  }
}

void Simulator::Impl::set_reaction(const Substep& sub, Block& row) const {
  const double time = impulse_time_of(sub, row) - 0.5 * sub.dt;
  if (is_drive(row)) {
    set_drive_reaction(sub, coordinates->drive(row), time, row);
  } else if (is_armature(row)) {
    set_armature_at_rate(rate_before(sub, row), scene->regularisation, row);
  } else if (is_joint_friction(row)) {
    set_joint_friction(sub, coordinates->friction(row), time, row);
  } else {
    set_motor(row, time);
  }
}

void Simulator::Impl::sum_drives(Substep& sub) {
  seed(sub);  // which knows the turns of hinges
  for (const int body : sub.part->moving) sub.drives_on[index(body)] = {};
  for (const Block& row : sub.rows) {
    if (!is_drive(row)) continue;
    double speed[kMaxRows];
    row_speeds(row, state.u, speed);
    const double effort = effort_at(coordinates->drive(row), coordinate_of(row), speed[0]);
    for (const int body : {row.a, row.b}) {
      if (body < 0) continue;
      MotorsOnBody& on = sub.drives_on[index(body)];
      (row.position_rows > 0 ? on.force : on.torque) += effort;
    }
  }
}

void Simulator::Impl::set_motor(Block& row, double time) const {
  const Motor& motor = coordinates->motor(row);
  row.bias[0] = -motor.velocity;
  row.hi = motor.effort * time;
  row.lo = -row.hi;
}

void Simulator::Impl::count_work(const Substep& sub, const SolveReport& solved,
                                 FrameReport& report) {
  SolverWork& work = report.work;
  ++work.solves;
  work.rows += count_rows(sub.rows);
  work.iterations += solved.iterations;
  work.row_updates += solved.row_updates;
  work.pivots += solved.pivots;
  work.passes += solved.passes;
  work.factorisations += solved.factorisations;
  work.flops += solved.flops;
  if (solved.status == SolveStatus::kUnsolved) ++work.unsolved;
  if (solved.status == SolveStatus::kUnsettled) ++work.unsettled;
}

void Simulator::Impl::count_visits(const Substep& sub, FrameReport& report) {
  report.visits += std::ssize(sub.part->moving) + std::ssize(sub.rows) +
                   index_of_last_frame.take_visits() + index_of_part.take_visits();
  if (contact) report.visits += contact->detector().take_visits();
  if (swept) report.visits += swept->take_visits();
}

// Checks the kinetic energy, which overflows long before the velocities.
bool Simulator::Impl::finite(const Substep& sub, FrameReport& report) {
  double squares = 0.0;
  for (const int body : sub.part->bodies)  // static bodies are checked too
    squares += state.u[index(body)].squaredNorm();
  if (!sub.shift.empty()) {
    for (const int body : sub.part->moving) squares += sub.shift[index(body)].squaredNorm();
  }
  if (std::isfinite(heaviest * squares)) return true;
  double sum = 0.0;
  for (const int body : sub.part->bodies) {  // look for a body that is too fast
    sum += most_kinetic(scene->bodies[index(body)], state.u[index(body)]);
    if (!sub.shift.empty()) sum += most_kinetic(scene->bodies[index(body)], sub.shift[index(body)]);
    if (std::isfinite(sum)) continue;
    stop(sub, body, report);
    return false;
  }
  return true;
}

void Simulator::Impl::stop(const Substep& sub, int body, FrameReport& report) {
  report.status = StepStatus::kNotFinite;
  report.failed_body = body;
  copy_of(sub.part->bodies, sub.u_start, state.u);
}

void Simulator::Impl::keep_forces(const Substep& sub) {
  if (!forces_are_stored(sub)) return;
  forces.resize(first_force);
  store_forces(sub, state, forces);
  index_of_part.clear();
}

bool Simulator::Impl::evaluate_stiffness(const Substep& sub, FrameReport& report) {
  const bool full = entry_of(settings.mode).full_stiffness;
  const bool known = !state.k.empty() && (!full || !state.K_resisting.empty());
  // The forces of an impact do not last, nor those that stop the rest of it in a short sub-step.
  if (sweeps_motion(sub) && (begins_with_impact || !sub.smooth) && known) {
    report.stages.stiffness = true;  // the last one is kept
    bound = StiffnessStage::bound(*scene, sub.part->bodies, state.k);
    return true;
  }
  if (!stiffness) stiffness = std::make_unique<StiffnessStage>(*scene);
  for (Block& block : sub.rows) find_lambda(sub, block, block.lambda);
  const ContactTerms terms = full ? ContactTerms::kNormal
                             : settings.contact_stiffness == ContactStiffness::kExact
                                 ? ContactTerms::kExact
                                 : ContactTerms::kPaper;
  stiffness->evaluate(*scene, sub.rows, terms, *sub.part, sub.R_WB, state.k);
  if (full) {  // bodies outside the part keep their values, as in k
    state.K_resisting.resize(state.k.size(), Mat3::Zero());
    for (const int body : sub.part->bodies) {
      state.K_resisting[index(body)] = resisting(stiffness->matrix().angular(body));
    }
  } else {
    state.K_resisting.clear();
  }
  bound = StiffnessStage::bound(*scene, sub.part->bodies, state.k);
  // In a diverging run K can overflow before the velocities.
  for (const int body : sub.part->bodies) {
    const std::size_t i = index(body);
    if (state.k[i].allFinite() && (!full || state.K_resisting[i].allFinite())) continue;
    stop(sub, body, report);
    state.k.clear();
    state.K_resisting.clear();
    return false;
  }
  remember_stiffness(*sub.part);
  ++report.criterion.evaluations;
  report.criterion.flops += criterion_flops(sub.rows, terms, stiffness->matrix());
  report.stages.stiffness = true;
  clock.lap(report.times.stiffness);
  return true;
}

// r per body, because islands merge and split.
void Simulator::Impl::remember_stiffness(const Part& part) {
  if (state.own.empty()) return;
  for (const int body : part.bodies) {
    double& r = state.own[index(body)].r;
    r = remembered(settings, StiffnessStage::bound(*scene, {&body, 1}, state.k).r, r);
  }
}

void Simulator::Impl::advance_poses(const Substep& sub, FrameReport& report) {
  const double dt = sub.dt;
  sub.integrator->move_poses(sub, state);
  if (sub.outputs_needed) sub.integrator->synchronise(sub, state);
  state.time += dt;
  state.dt_previous = dt;
  if (!state.own.empty()) {
    for (const int body : sub.part->bodies) state.own[index(body)].dt_previous = dt;
    if (!looks_for_islands(settings)) state.own.clear();  // all bodies share one clock
  }
  substeps_of_bodies += static_cast<std::int64_t>(sub.part->moving.size());
  count_visits(sub, report);
  report.dt_min = report.dt_min == 0.0 ? dt : std::min(report.dt_min, dt);
  report.dt_max = std::max(report.dt_max, dt);
  clock.lap(report.times.integrate);
}

}  // namespace substep
