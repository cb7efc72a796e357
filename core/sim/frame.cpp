// The start and end of a frame, and the probe.

#include <algorithm>
#include <limits>

#include "core/constraints/grab_rows.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/held_stiffness.hpp"
#include "core/stepping/integrate.hpp"
#include "core/stepping/stored_forces.hpp"

namespace substep {

namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

StageTimes no_times() {
  StageTimes times;
  times.joints = times.contact = times.friction = times.grab = kNotMeasured;
  times.mass = times.solve = times.stiffness = times.integrate = kNotMeasured;
  return times;
}

}  // namespace

RowCounts Simulator::Impl::count_rows(std::span<const Block> of) {
  RowCounts counts;
  for (const Block& block : of) {
    if (block.is_contact()) {
      ++counts.contact;
      counts.friction += block.rows - 1;
    } else if (is_grab(block)) {
      counts.grab += block.rows;
    } else {
      counts.joint += block.rows;
    }
  }
  return counts;
}

bool Simulator::Impl::probe_due() const {
  const bool reads_stiffness = chooses_substeps(settings.mode) || changes_mass(settings.mode);
  // Mode stiffness needs K_resisting, which other modes do not store.
  const bool known = state.stiffness_known &&
                     (!entry_of(settings.mode).full_stiffness || !state.K_resisting.empty());
  return settings.probe && reads_stiffness && !known;
}

// One solve over a whole frame with zeroed errors: only the forces are kept.
void Simulator::Impl::probe(FrameReport& report) {
  Substep once = current;
  once.settings = settings;
  once.settings.mode = Mode::kNone;               // Mt = M: k is not known yet
  once.settings.integrator = Integrator::kEuler;  // forces act for the whole of h
  const auto euler = make_integrator(*scene, joints.get(), once.settings);
  once.integrator = euler.get();
  once.part = &all;
  once.dt = once.planned_dt = scene->frame;
  once.probing = true;
  clock = StageClock(measures.stages);
  copy(state.u, once.u_start);
  bool solved = append_rows(once, report);
  if (solved) {
    external_forces(once, report);
    solved = solve(once, report) && finite(once, report);
  }
  if (solved) {
    state.forces.clear();
    if (forces_are_stored(once)) store_forces(once, state, state.forces);
    if (evaluate_stiffness(once, report)) state.r = bound.r;
  }
  copy(once.u_start, state.u);
  state.stiffness_known = true;
  report.status = StepStatus::kOk;  // a failed probe is not fatal
  report.failed_body = -1;
  report.stages.probe = true;
}

void Simulator::Impl::begin_frame() {
  FrameReport report;
  if (!measures.stages) report.times = no_times();
  contacts_predicted = false;
  substeps_of_bodies = 0;
  first_block = first_force = 0;
  rotation_matrices(all.bodies, state, current.R_WB);
  index_of_last_frame.clear();
  if (probe_due()) {  // the first frame has no lambda yet
    probe(report);
    index_of_last_frame.clear();
  }
  if (heeds_rotation()) {
    rotation->remember(*scene, state);
  } else {
    state.rotation.clear();
    state.rotation_age = 0.0;
  }
  if (settings.redo && chooses_substeps(settings.mode)) before_frame = state;
  if (watches_substeps(settings)) r_in_frame.assign(state.q.size(), 0.0);
  schedule_substeps(report);
  blocks.clear();
  forces.clear();
  open = report;
}

void Simulator::Impl::begin_again(FrameReport& report) {
  state = before_frame;
  contacts_predicted = false;
  first_block = first_force = 0;
  rotation_matrices(all.bodies, state, current.R_WB);
  index_of_last_frame.clear();
  report.n_discarded += report.n_substeps;
  report.parting = 0.0;
  report.lowered = 0;
  report.lowered_to = 1.0;
  report.n_substeps = 0;
  substeps_of_bodies = 0;
  report.dt_min = report.dt_max = 0.0;
  report.asleep = 0;
  schedule_substeps(report);
  blocks.clear();
  forces.clear();
  ++report.attempts;
}

void Simulator::Impl::schedule_substeps(FrameReport& report) {
  schedule.clear();
  if (!looks_for_islands(settings) || all.moving.empty()) {
    for (const OwnSubstep& own : state.own) state.r = std::max(state.r, own.r);
    schedule.add(all, clock_of(all.moving, state.r, rotation_bound(all.moving).r));
    return;
  }
  if (state.own.empty()) {
    for (std::size_t i = 0; i < state.q.size(); ++i) {
      const auto body = static_cast<int>(i);
      const double r =
          state.k.empty() ? state.r : StiffnessStage::bound(*scene, {&body, 1}, state.k).r;
      state.own.push_back({state.dt_previous, r});
    }
  }
  if (!islands) islands = std::make_unique<Islands>(*scene);
  islands->find(*scene, all, state, current.R_WB, scene->frame,
                contact ? &contact->detector() : nullptr);
  report.islands = islands->count();
  schedule_islands(report);
}

void Simulator::Impl::schedule_islands(FrameReport& report) {
  const auto r_of = [&](std::span<const int> bodies) {  // moving ones
    double most = 0.0;
    for (const int body : bodies) most = std::max(most, state.own[index(body)].r);
    return most;
  };
  islands->split(*scene, [&](std::span<const int> bodies) {
    if (is_at_rest(bodies)) {
      put_to_rest(bodies);
      report.asleep += static_cast<int>(bodies.size());
      return 0;
    }
    // Islands without their own number of sub-steps form one part.
    if (!has_islands(settings)) return 1;
    return clock_of(bodies, r_of(bodies), rotation_bound(bodies).r).left();
  });
  for (const Part& one : islands->parts()) {
    schedule.add(one, clock_of(one.moving, r_of(one.moving), rotation_bound(one.bodies).r));
  }
}

// N is not below what earlier frames and earlier attempts at this one need.
SubstepClock Simulator::Impl::clock_of(std::span<const int> moving, double r,
                                       double r_rotation) const {
  double r_least = held_stiffness(state, moving);
  if (watches_substeps(settings)) {
    for (const int body : moving) r_least = std::max(r_least, r_in_frame[index(body)]);
  }
  return {settings, scene->frame, r, r_rotation, r_least};
}

bool Simulator::Impl::heeds_rotation() const {
  return rotation && settings.rotation_criterion && chooses_substeps(settings.mode);
}

RotationBound Simulator::Impl::rotation_bound(std::span<const int> bodies) const {
  return heeds_rotation() ? rotation->bound(*scene, bodies, state) : RotationBound{};
}

double Simulator::Impl::watch_substep(const Substep& sub) {
  const bool watches = watches_substeps(settings);
  if (!watches && !decides_again(settings)) return 0.0;
  // Joints that do not close need half the length.
  const double closing =
      joints_open ? 16.0 * settings.alpha / (sub.planned_dt * sub.planned_dt) : 0.0;
  double most = closing;
  for (const int body : schedule.part().moving) {
    const double r_rotation = rotation_bound({&body, 1}).r;
    most = std::max(most, r_rotation);
    if (!watches) continue;
    double& r = r_in_frame[index(body)];
    r = std::max({r, closing, r_rotation, StiffnessStage::bound(*scene, {&body, 1}, state.k).r});
  }
  return most;
}

FrameReport Simulator::Impl::refusal() {
  FrameReport report;
  look(report);
  report.status = StepStatus::kInvalid;
  return report;
}

FrameReport Simulator::Impl::end(StageClock& wall, bool looked_at) {
  FrameReport& report = *open;
  const bool done = report.status != StepStatus::kOk || !schedule.running();
  if (done) {
    close(report);
  } else if (looked_at) {
    look(report);
  }
  wall.lap(report.times.total);
  const FrameReport result = report;
  if (done) open.reset();
  return result;
}

void Simulator::Impl::carry_to_next_frame(const FrameReport& report) {
  time_rest();
  if (report.asleep > 0) keep_forces_at_rest();
  std::swap(state.forces, forces);
  state.r = schedule.r();
  hold_stiffness(settings, r_in_frame, state);
  state.stiffness_known = report.stages.stiffness;
  if (state.stiffness_known) return;
  state.k.clear();  // outdated
  state.K_resisting.clear();
  state.r = 0.0;
}

void Simulator::Impl::close(FrameReport& report) {
  report.n_wanted = schedule.n_wanted();
  report.capped = schedule.capped();
  if (!all.moving.empty()) {
    report.n_mean =
        static_cast<double>(substeps_of_bodies) / static_cast<double>(all.moving.size());
  }
  if (report.status == StepStatus::kOk) {
    if (report.n_substeps > 0) carry_to_next_frame(report);  // else all bodies sleep
    ++state.frame;
    state.time = static_cast<double>(state.frame) * scene->frame;  // avoids accumulated rounding
  } else {
    copy(state.u, state.u_synchronised);  // an approximation
  }
  report.work.residual =
      measures.errors ? lcp_residual({blocks.all(), current.inverse_mass, state.u}) : kNotMeasured;
  const RowCounts rows = count_rows(blocks.all());
  report.joint_rows = static_cast<int>(rows.joint);
  report.contact_rows = static_cast<int>(rows.contact);
  report.friction_rows = static_cast<int>(rows.friction);
  look(report);
  if (report.status != StepStatus::kOk) stopped = report;
}

void Simulator::Impl::look(FrameReport& report) {
  if (measures.errors || measures.energies) rotation_matrices(all.bodies, state, end_axes);
  observe(measures, end_axes, contact ? &contact->detector() : nullptr, report);
}

// The gap of a stiff row is mostly error, so its energy follows from the force: C lambda^2 / 2.
double Simulator::Impl::stiff_elastic() const {
  double energy = 0.0;
  double lambda[kMaxRows];
  for (const Block& block : blocks.all()) {
    if (block.is_contact() || block.id >= scene->joints.size()) continue;  // or the grab
    find_lambda(current, block, lambda);
    for (int row = 0; row < block.rows; ++row) {
      if (joints->is_spring(static_cast<std::size_t>(block.id), row, block)) continue;
      energy += 0.5 * block.C[row] * lambda[row] * lambda[row];
    }
  }
  return energy;
}

void Simulator::Impl::observe(const Measures& asked, std::span<const Mat3> axes, Detector* detector,
                              FrameReport& report) const {
  report.frame = state.frame;
  report.time = state.time;
  const RotationBound spin = rotation_bound(all.moving);
  report.r_stiffness = state.r;
  report.r_rotation = spin.r;
  report.rotation_body = spin.body;
  report.dt_stable = stable_step(settings.alpha, std::max(state.r, spin.r));
  if (!state.k.empty()) report.leader = StiffnessStage::bound(*scene, all.bodies, state.k);
  Energies energies{kNotMeasured, kNotMeasured};
  if (asked.energies) energies = energies_of(*scene, state);
  report.kinetic = energies.kinetic;
  report.potential = energies.potential;
  report.springs = asked.energies ? 0.0 : kNotMeasured;
  const bool soft = is_soft(scene->contact);
  if (joints && (asked.errors || (asked.energies && joints->has_springs()))) {
    const JointErrors errors = joints->errors(state, axes);
    report.constraint_error = errors.sum;
    report.joint_gap = errors.gap;
    report.joint_gap_joint = errors.joint;
    report.torn = errors.torn;
    report.torn_joint = errors.torn_joint;
    report.springs += errors.springs;
  }
  if (coordinates && asked.energies) report.springs += coordinates->elastic(state, axes);
  if (detector != nullptr && (asked.errors || (asked.energies && soft))) {
    const Overlaps found = overlaps(*detector, *scene, all, state, axes);
    report.penetration = found.deepest;
    report.inside = found.inside;
    report.inside_a = found.a;
    report.inside_b = found.b;
    if (soft) report.springs += 0.5 * found.squares / scene->contact.compliance;
  }
  report.energy = energies.sum() + report.springs;
  report.elastic = report.springs + (asked.energies ? stiff_elastic() : 0.0);
  if (!asked.errors) {
    report.constraint_error = report.joint_gap = report.torn = report.penetration = report.inside =
        kNotMeasured;
  }
}

}  // namespace substep
