// Impacts between two sub-steps.
//
// A sub-step ends where bodies meet fast: it is shortened, and taken with their contacts open. The
// next one begins with the impact, on the velocities at the time of the poses and with the
// gradients of all joints and contacts there. Impacts of bodies on joints, and those without a
// rebound, are then as accurate as the motion between them. What meets slowly, and what exceeds the
// limit of SubstepClock::may_shorten(), meets within a sub-step (swept.cpp, impacts.cpp).

#include <algorithm>
#include <cmath>

#include "core/constraints/grab_rows.hpp"
#include "core/sim/lower_restitution.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/armature.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/drift.hpp"

namespace substep {
namespace {

constexpr double kResting = 10.0;    // largest gap of what rests, in units of touching()
constexpr int kMostShortenings = 4;  // of one sub-step, until it ends at the impact
constexpr int kMostPasses = 200;     // in which impacts spread, at the start of a sub-step

bool is_spring(const Block& joint, int row) { return is_grab(joint) || joint.C[row] > 0.0; }

void reset_row(Block& block) {
  std::fill(std::begin(block.bias), std::end(block.bias), 0.0);
  std::fill(std::begin(block.impulse), std::end(block.impulse), 0.0);
  std::fill(std::begin(block.given), std::end(block.given), 0.0);
  if (block.is_motor()) block.lo = block.hi = 0.0;
  if (block.is_unilateral()) {
    std::fill(std::begin(block.active_set), std::end(block.active_set), kUnknownSet);
  }
}

// Springs keep their speed, a grab exerts no impulse.
void set_joint(std::span<const InverseMass> inverse_mass, std::span<const Vec6> u, Block& joint) {
  if (joint.is_motor()) return;
  double speed[kMaxRows];
  row_speeds(joint, u, speed);
  for (int row = 0; row < joint.rows; ++row) {
    joint.bias[row] = is_spring(joint, row) ? -speed[row] : 0.0;
    if (is_grab(joint)) give_force(inverse_mass, joint, row, 0.0);
  }
}

}  // namespace

// Solvers that hold joints at the end of a sub-step turn their gaps into speed, the more the
// shorter it is.
bool Simulator::Impl::may_shorten(const Substep& sub) const {
  // All bodies of a part take the shortened sub-step: crowds cannot afford many.
  constexpr int kFew = 4;
  constexpr int kBodies = 64;
  const auto bodies = static_cast<int>(std::max(std::size_t{1}, sub.part->moving.size()));
  const int few = std::min(kFew, kBodies / bodies);
  const SolverKind by = sub.settings.solver;
  return schedule.clock().may_shorten(few) &&
         (!joints || by == SolverKind::kBpp || by == SolverKind::kPgs);
}

bool Simulator::Impl::solve_until_impact(Substep& sub, FrameReport& report) {
  const std::size_t known = blocks.size();
  dt_before = state.dt_previous;
  own_before.assign(state.own.begin(), state.own.end());
  acceleration_before.assign(state.acceleration.begin(), state.acceleration.end());
  change_before.assign(state.acceleration_change.begin(), state.acceleration_change.end());
  whole_dt = sub.dt;
  shortened = 0;
  for (;;) {
    ends_at = 0.0;
    if (!solve_swept(sub, shortened < kMostShortenings && may_shorten(sub), report)) return false;
    if (ends_at == 0.0) return true;
    ++shortened;
    sub.dt = ends_at;
    schedule.shorten(sub.dt);
    blocks.keep(known);
    sub.rows = blocks.from(first_block);
    for (Block& block : sub.rows) block.curved = 0.0;
    copy_of(sub.part->bodies, sub.u_start, state.u);
    state.dt_previous = dt_before;
    state.own.assign(own_before.begin(), own_before.end());
    state.acceleration.assign(acceleration_before.begin(), acceleration_before.end());
    state.acceleration_change.assign(change_before.begin(), change_before.end());
    external_forces(sub, report);
  }
}

/// Speed that the forces of a whole sub-step give to the bodies of a contact [m/s] or a limit
/// [rad/s or m/s].
double Simulator::Impl::speed_in_substep(const Substep& sub, const Block& block) const {
  if (!block.is_contact()) return speed_by_forces(sub, block);
  return speeds_of(block, gain) * sub.planned_dt / impulse_time_of(sub, block);
}

// Slower ones are stopped within a sub-step: its forces change speeds by more, or they are what the
// softness leaves of an impact.
bool Simulator::Impl::is_fast(const Substep& sub, const Block& block, double approach) const {
  constexpr double kSlow = 0.1;
  constexpr double kLeft = 10.0 * kRigidContact;
  return approach > std::max({kSlow * speed_in_substep(sub, block),
                              block.is_contact() ? kSlow * scene->contact.restitution_speed : 0.0,
                              kLeft * speeds_of(block, sub.u_before)});
}

// What rests has no approach before the forces.
bool Simulator::Impl::arrives(const Substep& sub, const Block& block) const {
  if (block.soft || (block.is_coordinate() && block.was_closed)) return false;
  return is_fast(sub, block, -normal_speed(block, sub.u_before));
}

/// The half width of the narrower shape [m]; its measure for a limit [rad or m].
double Simulator::Impl::width_of(const Block& block) const {
  return block.is_contact() ? contact->detector().half_width(block.body_a, block.body_b)
                            : coordinates->width_of(block);
}

/// The gap below which bodies touch [m], or a limit is closed [rad or m].
double Simulator::Impl::touching(const Block& block) const {
  return SweptContacts::kAllowedOverlap * width_of(block);
}

/// When a contact closes, from the start of the sub-step [s]: phi + t (J w - later forces) = 0.
double Simulator::Impl::closing_time(const Substep& sub, const Block& block) const {
  const double speed = normal_speed(block, w);
  const double by_forces = (normal_speed(block, state.u) - normal_speed(block, sub.u_before)) /
                           impulse_time_of(sub, block);
  const double dt_previous = dt_previous_of(state, block);
  double time = -block.phi[0] / speed;
  for (int i = 0; i < 3; ++i) {
    const double later = sub.integrator->force_time(dt_previous, sub.dt) -
                         sub.integrator->force_time(dt_previous, std::clamp(time, 0.0, sub.dt));
    const double then = speed - later * by_forces;
    if (!(then < 0.0)) return kUnbounded;
    time = -block.phi[0] / then;
  }
  return time;
}

// Rows that may close fast are open until it is known when.
void Simulator::Impl::await_impacts(const Substep& sub, bool shortens) {
  for (Block& block : sub.rows) {
    if (!block.is_unilateral()) continue;
    block.awaits = shortens && block.phi[0] > touching(block) && arrives(sub, block);
  }
}

// After a sweep: ends the sub-step at its first impact, or decides which contacts wait for the next
// one. Where the sub-step ends at an impact already, the time is corrected until they touch.
SweptContacts::Found Simulator::Impl::settle_waiting(const Substep& sub, std::size_t solved,
                                                     SweptContacts::Found found) {
  const double late = (1.0 - RestitutionStage::kSimultaneous) * sub.dt;
  const auto is_new = [&](std::size_t i, const Block& block) {
    return block.is_unilateral() && (i >= solved || block.awaits);
  };
  double first = kUnbounded;
  double tolerance = 0.0;  // of the time, where the sub-step ends at it already [s]
  bool early = false;
  for (std::size_t i = first_block; i < blocks.size(); ++i) {
    const Block& block = blocks.all()[i];
    if (!is_new(i, block) || !arrives(sub, block)) continue;
    const double time = closing_time(sub, block);
    early = early || time < RestitutionStage::kSimultaneous * sub.dt;
    if (time > first) continue;
    first = time;
    tolerance = -0.5 * touching(block) / normal_speed(block, w);
  }
  const bool at_end = shortened ? std::abs(first - sub.dt) < tolerance : first >= late;
  const double latest =
      std::min(kAhead * sub.dt, (1.0 - RestitutionStage::kSimultaneous) * whole_dt);
  if (!early && !at_end && first < latest) {
    ends_at = first;
    return found;
  }
  SweptContacts::Found left = std::min(found, SweptContacts::Found::kOverlaps);
  for (std::size_t i = first_block; i < blocks.size(); ++i) {
    Block& block = blocks.all()[i];
    if (!is_new(i, block)) continue;
    block.awaits = arrives(sub, block) && closing_time(sub, block) >= late;
    if (!block.awaits) left = SweptContacts::Found::kContacts;
  }
  return left;
}

// What joints, motors, drives and resting contacts change of the velocities u at the start.
void Simulator::Impl::set_reactions(const Substep& sub, std::span<const Vec6> u,
                                    std::span<Block> rows) {
  for (Block& block : rows) {
    reset_row(block);
    if (block.is_motor()) set_reaction(sub, block);
    if (!block.is_unilateral()) {
      set_joint(sub.inverse_mass, u, block);
      continue;
    }
    if (block.soft || block.phi[0] > kResting * touching(block) || arrives(sub, block)) {
      block.bias[0] = kStaysOpen;
    }
  }
}

// One simultaneous impact of all contacts that are struck. Others that would rebound are open: the
// impact spreads to them. @return true if there are any
bool Simulator::Impl::set_hits(const Substep& sub, std::span<const Vec6> u, double share,
                               std::span<Block> rows) {
  bool any = false;
  for (Block& block : rows) {
    reset_row(block);
    if (is_armature(block)) {
      set_armature_at_rate(normal_speed(block, u), scene->regularisation, block);
    }
    if (!block.is_unilateral()) {
      set_joint(sub.inverse_mass, u, block);
      continue;
    }
    const double approach = -normal_speed(block, u);
    const bool fast = is_fast(sub, block, approach);
    const double e = restitution ? restitution->restitution_of(block) : 0.0;
    if (block.soft || block.phi[0] > (fast ? 1.0 : kResting) * touching(block)) {
      block.bias[0] = kStaysOpen;
    } else if (fast) {
      any = true;
      // What returns within the sub-step rests.
      const bool rebounds = (!block.is_contact() || approach >= scene->contact.restitution_speed) &&
                            e * approach > speed_in_substep(sub, block);
      block.bias[0] = rebounds ? -share * e * approach : 0.0;
    } else if (e > 0.0) {
      block.bias[0] = kStaysOpen;
    }
  }
  return any;
}

bool Simulator::Impl::strike(Substep& sub, FrameReport& report) {
  begins_with_impact = false;
  u_meeting.assign(sub.u_before.begin(), sub.u_before.end());
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    u_meeting[i].tail<3>() = sub.integrator->spin_at_start(sub, i);
    u_meeting[i] += (1.0 - 0.5 * sub.dt / sub.impulse_time[i]) * gain[i];
  }
  const auto struck = [&](const Block& block) {
    return block.is_unilateral() && block.phi[0] <= touching(block) && arrives(sub, block);
  };
  if (std::none_of(sub.rows.begin(), sub.rows.end(), struck)) return true;
  impact_rows.clear();
  for (const Block& row : sub.rows) impact_rows.append() = row;
  contact_softness = kRigidContact;
  set_softness(sub, impact_rows.all());
  const std::span<const InverseMass> masses = masses_of_impacts(sub);
  set_reactions(sub, u_meeting, impact_rows.all());
  if (!solve_impacts(sub, impact_rows.all(), u_meeting, masses, report)) return false;
  u_arriving.assign(u_meeting.begin(), u_meeting.end());
  const auto solve = [&](double share) {
    copy(u_star, u_meeting);
    set_hits(sub, u_meeting, share, impact_rows.all());
    return solve_impacts(sub, impact_rows.all(), u_meeting, masses, report);
  };
  const auto work = [&] {
    report.work.flops += impact_solver().find_impulses(impact_rows.all());
    return work_of_contacts(sub, impact_rows.all(), u_star, u_meeting, false);
  };
  u_star.assign(u_meeting.begin(), u_meeting.end());
  for (int i = 0; i < kMostPasses && set_hits(sub, u_star, 1.0, impact_rows.all()); ++i) {
    if (!solve(1.0)) return false;
    const ContactWork full = work();
    if (full.adds()) {
      const auto share = lower_restitution(full, solve, work, u_meeting, u_rebounding);
      if (!share) return false;
      lower_to(*share);
    }
    copy(u_meeting, u_star);
  }
  start_from(sub, u_arriving, u_star);
  begins_with_impact = true;
  return true;
}

// After the impacts. The velocities of the sub-step before are of its middle, and what joints and
// contacts exert has changed since: the sub-step starts from those at the time of the poses. Where
// springs act, which reactions do not contain, only the change is added.
void Simulator::Impl::start_from(Substep& sub, std::span<const Vec6> u_minus,
                                 std::span<const Vec6> u_plus) {
  const bool springs = std::any_of(sub.rows.begin(), sub.rows.end(), [](const Block& block) {
    if (block.is_contact()) return block.soft;
    return is_spring(block, 0) || is_spring(block, block.rows - 1);
  });
  const bool starts = !springs && sub.integrator->starts_at_poses();
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    const Vec6 acceleration = 1.0 / sub.impulse_time[i] * gain[i];
    Vec6 after = u_plus[i];
    if (starts) {
      set_dt_previous(body, 0.0);
      sub.impulse_time[i] = sub.integrator->force_time(0.0, sub.dt);
    } else {
      Vec6 before = sub.u_before[i];
      before.tail<3>() = sub.integrator->spin_at_start(sub, i);
      after += before - u_minus[i];
    }
    sub.u_before[i].head<3>() = after.head<3>();
    sub.u_before[i].tail<3>() = sub.integrator->strike(sub, i, after.tail<3>());
    gain[i] = sub.impulse_time[i] * acceleration;
    state.u[i] = sub.u_before[i] + gain[i];
    if (starts || u_plus[i] != u_minus[i]) sub.integrator->forget(i, state);
  }
  sub.integrator->keep_strikes(sub);
}

// Contacts that touch after a strike rest, or separate: their forces contain no impact.
void Simulator::Impl::close_struck(const Substep& sub) const {
  for (Block& block : sub.rows) {
    if (!block.is_unilateral() || block.soft) continue;
    if (block.phi[0] <= kResting * touching(block)) block.was_closed = true;
  }
}

void Simulator::Impl::set_dt_previous(int body, double dt) {
  if (state.own.empty()) {
    state.dt_previous = dt;
  } else {
    state.own[index(body)].dt_previous = dt;
  }
}

}  // namespace substep
