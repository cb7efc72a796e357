// Contacts found along the motion of a sub-step (detection continuous).
//
// The sub-step is solved with the contacts that touch at its start. If the motion then closes
// others fast, it ends there (strike.cpp); else their rows are added and it is solved again.
// Velocities and poses are corrected apart, as in Moreau's scheme with projection (Acary 2013): the
// motion is dt (u+ + shift), and the shift, which no velocity sees,
//   - begins a rebound where and when the contact closes: an impulse after the time t of a sub-step
//     moves the body for dt - t only;
//   - keeps shapes apart that a curved motion would overlap;
//   - parts shapes that overlap at the start, at a bounded speed.
// Rows of velocities therefore never push bodies apart but to rebound: they add no energy.

#include <algorithm>

#include "core/forces/applied_forces.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/drift.hpp"

namespace substep {
namespace {

constexpr int kMostSolves = 8;  // for velocities, in a sub-step
constexpr int kMostShifts = 4;  // for shifts

// Of shapes that overlap at the start.
constexpr double kFastestParting = 1.0;  // half widths of the narrower shape per second
constexpr double kPartRate = 0.2;        // of the overlap in a sub-step
constexpr double kFastestShift = 1.0;    // of a body: of its radius, or in radians, per second

}  // namespace

bool Simulator::Impl::sweeps_motion(const Substep& sub) const {
  return unilateral() && sub.settings.detection == Detection::kContinuous && !sub.probing;
}

void Simulator::Impl::predict_motions(const Substep& sub) {
  sub.integrator->predict_velocities(sub, state, w);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    if (!sub.shift.empty()) w[i] += sub.shift[i];
    motions[i] = motion(w[i], sub.dt);
  }
}

// Appends what the motion closes, with friction.
SweptContacts::Found Simulator::Impl::sweep(Substep& sub, double until) {
  predict_motions(sub);
  const std::size_t known = blocks.size();
  const SweptContacts::Sweep motion{*scene, *sub.part, state, sub.R_WB, w, sub.dt, until};
  SweptContacts::Found found = SweptContacts::Found::kNothing;
  if (contact) found = swept->append(motion, contact->detector(), first_block, blocks);
  if (coordinates) found = std::max(found, coordinates->sweep(motion, first_block, blocks));
  if (friction) friction->append(*scene, sub.R_WB, blocks.from(known));
  set_softness(sub, blocks.from(known));
  sub.rows = blocks.from(first_block);
  return found;
}

bool Simulator::Impl::solve_swept(Substep& sub, bool shortens, FrameReport& report) {
  if (!swept) {
    swept = std::make_unique<SweptContacts>();
    swept->reserve(blocks.capacity());
    parting.reserve(blocks.capacity());
    impact_rows.reserve(blocks.capacity());
    impact_solver().reserve(state.u.size(), blocks.capacity(), has_loops);
  }
  gain.resize(state.u.size());
  u_rebounding.resize(state.u.size());
  u_arriving.resize(state.u.size());
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = state.u[i] - sub.u_before[i];
  lowered = 0;
  lowered_to = 1.0;
  sub.solved = 0;
  if (coordinates) seed(sub);  // whether a limit rests is known from its last force
  if (!strike(sub, report)) return false;
  const int lowered_at_start = lowered;
  const double lowered_at_start_to = lowered_to;
  sub.gain = gain;
  u_forced.assign(state.u.begin(), state.u.end());
  u_unforced.assign(sub.u_before.begin(), sub.u_before.end());
  await_impacts(sub, shortens);
  SweptContacts::Found found = SweptContacts::Found::kContacts;
  std::size_t solved = 0;  // blocks
  for (int solves = 0; solves < kMostSolves && found == SweptContacts::Found::kContacts; ++solves) {
    if (solves > 0 && !within_budget(sub, report)) return false;
    if (!solve_softly(sub, report)) return false;
    solved = blocks.size();
    sub.solved = solved - first_block;
    found = sweep(sub, shortened > 0 ? kAhead * sub.dt : sub.dt);
    if (too_many_swept()) {
      report.status = StepStatus::kTooManyContacts;
      report.overrun.budget = budget.contacts;
      drop_rows(sub);
      return false;
    }
    if (shortens) found = settle_waiting(sub, solved, found);
    if (ends_at > 0.0) return true;
    if (solves == 0 && found == SweptContacts::Found::kContacts) add_reactions(sub, solved);
  }
  report.lowered += lowered_at_start + lowered;
  report.lowered_to = std::min({report.lowered_to, lowered_at_start_to, lowered_to});
  const auto overlaps = [&](const Block& block) { return parts(block); };
  bool shifts = found != SweptContacts::Found::kNothing ||
                std::any_of(sub.rows.begin(), sub.rows.end(), overlaps);
  for (int shifted = 0; shifts; ++shifted) {
    const double before = lift_by_shift(sub);
    const bool found_shift = shifted < kMostShifts && find_shift(sub, report);
    if (found_shift) report.parting += lift_by_shift(sub) - before;
    if (report.status != StepStatus::kOk) return false;
    if (!found_shift) {  // the bodies stop where they meet
      const double met = std::min(contact ? swept->earliest() : sub.dt,
                                  coordinates ? coordinates->earliest() : sub.dt);
      const double rest = 1.0 - met / sub.dt;
      for (const int body : sub.part->moving) shift[index(body)] -= rest * w[index(body)];
      break;
    }
    shifts = sweep(sub, sub.dt) != SweptContacts::Found::kNothing;
  }
  blocks.keep(solved);  // those found since have no forces
  sub.rows = blocks.from(first_block);
  return true;
}

// What joints and resting contacts hold does not fall with the forces until it is struck: the gain
// is that of the motion without the contacts that it closes, unless that is an impact itself.
void Simulator::Impl::add_reactions(const Substep& sub, std::size_t solved) {
  if (!sub.struck.empty()) return;
  const std::span<const Block> rows = sub.rows.first(solved - first_block);
  const bool hits = std::any_of(rows.begin(), rows.end(), [&](const Block& block) {
    return block.is_unilateral() && block.impulse[0] > 0.0 &&
           block.phi[0] > sub.dt * speed_by_forces(sub, block);
  });
  if (hits) return;
  for (const int body : sub.part->moving) {
    gain[index(body)] = state.u[index(body)] - u_unforced[index(body)];
  }
}

// Solves with rigid contacts; if the solver finds no solution, as can be where many touch at once,
// with softer ones: what BPP then falls back to could add energy.
bool Simulator::Impl::solve_softly(Substep& sub, FrameReport& report) {
  for (const double softness : {kRigidContact, 100.0 * kRigidContact, 1e4 * kRigidContact}) {
    contact_softness = softness;
    const std::int64_t unsolved = report.work.unsolved;
    if (!solve_afresh(sub, report)) return false;
    if (rebounds_add_energy(sub)) {
      separates = false;
      const bool solved = solve_afresh(sub, report);
      separates = true;
      if (!solved) return false;
      lower_to(0.0);
    }
    if (last_solve < SolveStatus::kUnsolved) break;
    if (softness < 1e4 * kRigidContact) report.work.unsolved = unsolved;
    sub.solved = 0;  // what the solver fell back to is no start
  }
  return true;
}

bool Simulator::Impl::solve_afresh(Substep& sub, FrameReport& report) {
  copy(u_forced, state.u);
  copy(u_unforced, sub.u_before);
  sub.integrator->begin_solve(sub);
  shift.assign(state.u.size(), Vec6::Zero());
  sub.shift = shift;
  exchanged = 0.0;
  lowered = 0;
  lowered_to = 1.0;
  return solve_rows(sub, report);
}

// The potentials are linear in the position.
double Simulator::Impl::lift_by_shift(const Substep& sub) const {
  double lift = 0.0;
  for (const int i : sub.part->moving) {
    const Vec3 way = sub.dt * shift[index(i)].head<3>();
    for_each_force(scene->effects, [&](auto force) {
      lift += force.potential(*scene, scene->bodies[index(i)], way);
    });
  }
  return lift;
}

bool Simulator::Impl::too_many_swept() const {
  if (!contact) return false;
  const std::size_t others = (joints ? scene->joints.size() + 1 : 1) +  // and a grab
                             (coordinates ? coordinates->size() : 0);
  const auto most = static_cast<double>(others) + budget.contacts;
  return contact->detector().too_many() || static_cast<double>(blocks.size() - first_block) > most;
}

bool Simulator::Impl::parts(const Block& block) const {
  return block.is_unilateral() && !block.soft && block.phi[0] < -touching(block);
}

bool Simulator::Impl::is_deep(const Block& block) const {
  constexpr double kSinks = 0.01;  // at most, of the half width
  return block.phi[0] < -kSinks * width_of(block);
}

/// At which the shift parts an overlap [m/s] or closes a limit [rad/s or m/s].
double Simulator::Impl::parting_speed(const Substep& sub, const Block& row) const {
  if (!row.is_unilateral() || row.soft || !(row.phi[0] < 0.0)) return 0.0;
  return std::min(-kPartRate * row.phi[0] / sub.dt, kFastestParting * width_of(row));
}

/// Largest speed of a body by the shift: linear in its radii, or angular in radians [1/s].
double Simulator::Impl::fastest_shift(const Substep& sub) const {
  double fastest = 0.0;
  for (const int body : sub.part->moving) {
    const Vec6& by = shift[index(body)];
    fastest = std::max({fastest, by.tail<3>().norm(),
                        by.head<3>().norm() / radius_around(scene->bodies[index(body)].shape)});
  }
  return fastest;
}

bool Simulator::Impl::ends_impact(const Substep& sub, const Block& block) const {
  if (!sweeps_motion(sub) || !(block.impulse[0] > 0.0)) return false;
  return -normal_speed(block, sub.u_before) > speed_by_forces(sub, block);
}

// The smallest change of the shift that keeps shapes apart at the end, and joints. Returns false if
// none is found.
bool Simulator::Impl::find_shift(Substep& sub, FrameReport& report) {
  parting.clear();
  predict_motions(sub);
  // If one overlap is too deep, all are parted: a pile then needs it in few sub-steps.
  const bool any_parts = std::any_of(sub.rows.begin(), sub.rows.end(),
                                     [&](const Block& block) { return parts(block); });
  for (const Block& row : sub.rows) {
    Block& block = parting.append();
    block = row;
    for (int i = 0; i < kMaxRows; ++i) {
      block.bias[i] = block.impulse[i] = block.given[i] = 0.0;
      if (!block.is_bounded()) block.softness[i] = scene->regularisation;
    }
    if (block.is_motor()) block.lo = block.hi = 0.0;
    if (!block.is_unilateral()) continue;
    block.rows = 1;  // without friction
    std::fill(std::begin(block.active_set), std::end(block.active_set), kUnknownSet);
    const double speed = normal_speed(block, w) - normal_speed(block, shift);
    block.bias[0] = speed + (std::max(row.phi[0], 0.0) + row.curved) / sub.dt;
    if (any_parts) block.bias[0] -= parting_speed(sub, row);
  }
  Solver& by = impact_solver();
  System system{parting.all(), sub.inverse_mass,     shift, {}, sub.dt,
                sub.R_WB,      scene->regularisation};
  system.limits = limits_of_solve(sub, report);
  system.contacts_yield = true;
  copy(shift, u_star);
  SolveReport solved = by.find_velocities(system, sub.settings);
  // Next to a joint, a small distance at the contact is a large angle.
  const double fastest = any_parts ? fastest_shift(sub) : 0.0;
  if (fastest > kFastestShift && solved.status < SolveStatus::kUnsolved) {
    for (std::size_t i = 0; i < parting.size(); ++i) {
      parting.all()[i].bias[0] += (1.0 - kFastestShift / fastest) * parting_speed(sub, sub.rows[i]);
    }
    copy(u_star, shift);
    count_work(sub, solved, report);
    solved = by.find_velocities(system, sub.settings);
  }
  if (closes_joints(sub)) close_joints(sub, system, by, solved);
  if (solved.status == SolveStatus::kOverLimits) {
    refuse_solve(sub, solved, report);
    return false;
  }
  count_work(sub, solved, report);
  if (solved.status < SolveStatus::kUnsolved) return true;
  copy(u_star, shift);
  predict_motions(sub);
  return false;
}

}  // namespace substep
