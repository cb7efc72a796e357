// Propagation of impacts between bodies within a sub-step.

#include <algorithm>
#include <cmath>

#include "core/sim/simulator_impl.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {

Solver& Simulator::Impl::impact_solver() {
  if (!impacts) {
    impacts =
        make_solver(settings.solver == SolverKind::kPgs ? SolverKind::kPgs : SolverKind::kBpp);
  }
  return *impacts;
}

// Newton's restitution law uses speeds before the impact. It cannot propagate an impact through
// touching bodies: a ball striking a row of balls would carry the whole row along and lose most of
// its energy. Impacts are therefore resolved in passes within the sub-step, without forces, until
// none is left: all pending ones simultaneously, or the first ones where their times are known.
// This conserves energy for e = 1 and preserves symmetry (Smith et al., Reflections on simultaneous
// impact, 2012).
bool Simulator::Impl::propagate_impacts(Substep& sub, FrameReport& report) {
  if (!restitution || sub.probing) return true;
  const bool sweeps = sweeps_contacts(sub);
  std::span<const Vec6> u = sub.u_before;
  if (sweeps) {
    // A tumbling body has its momentum, and the energy that a rebound conserves, at the poses of
    // the start.
    copy(sub.u_before, u_star);
    for (const int body : sub.part->moving) {
      u_star[index(body)].tail<3>() = integrator->spin_at_start(sub, index(body));
    }
    u = u_star;
  }
  const bool spreads = restitution->spreads(sub, u, sub.rows);
  sub.struck = restitution->struck();
  if (!spreads) return true;
  std::span<const InverseMass> masses = sub.inverse_mass;
  if (changes_mass(settings.mode)) {  // no time passes: no damping or geometric stiffness
    rigid_mass.resize(sub.inverse_mass.size());
    inverse_mass(sub.inertia_inverse, *sub.part, sub.R_WB, rigid_mass);
    masses = rigid_mass;
  }
  for (const int body : sub.part->moving) state.u[index(body)] -= sub.u_before[index(body)];
  if (sweeps) copy(u_star, sub.u_before);
  // Impacts among many bodies can continue indefinitely at decreasing speed. After this many passes
  // the rest is resolved at once, as a single impact, or along the motion without a rebound.
  constexpr int kMostImpacts = 200;
  for (int i = 0; restitution->set_impacts(sub, sub.u_before, 1.0, sub.rows) && i < kMostImpacts;
       ++i) {
    if (sweeps) copy(sub.u_before, u_star);
    if (!solve_impacts(sub, masses, report)) return false;
    if (!sweeps) continue;
    if (!lower_restitution(sub, masses, report)) return false;
    // The impulse moves the bodies only from the time of the impact on.
    for (const int body : sub.part->moving) {
      shift[index(body)] -= restitution->late() * (sub.u_before[index(body)] - u_star[index(body)]);
    }
  }
  for (const int body : sub.part->moving) {
    Vec6& after = sub.u_before[index(body)];
    if (sweeps) after.tail<3>() = integrator->strike(sub, index(body), after.tail<3>());
    state.u[index(body)] += after;
  }
  return true;
}

bool Simulator::Impl::solve_impacts(Substep& sub, std::span<const InverseMass> masses,
                                    FrameReport& report) {
  System system{sub.rows, masses, sub.u_before, {}, sub.dt, sub.R_WB, scene->regularisation};
  system.limits = limits_of_solve(sub, report);
  const SolveReport solved = impact_solver().find_velocities(system, settings);
  if (solved.status == SolveStatus::kOverLimits) {
    refuse_solve(sub, solved, report);
    return false;
  }
  count_work(sub, solved, report);
  ++report.work.impacts;
  return true;
}

// impulse . (w + w+)/2.
Simulator::Impl::ContactWork Simulator::Impl::work_of_contacts(const Substep& sub,
                                                               std::span<const Vec6> u,
                                                               std::span<const Vec6> u_plus,
                                                               bool of_impacts) const {
  ContactWork work;
  for (std::size_t i = 0; i < sub.rows.size(); ++i) {
    const Block& block = sub.rows[i];
    if (!block.is_contact()) continue;  // joints that hold do no work
    double before[kMaxRows];
    double after[kMaxRows];
    double gained[kMaxRows] = {};
    row_speeds(block, u, before);
    row_speeds(block, u_plus, after);
    double forced = 0.0;
    if (of_impacts) {  // when the contact closes
      row_speeds(block, sub.gain, gained);
      forced = restitution->force_time(i) / impulse_time_of(sub, block);
    }
    for (int row = 0; row < block.rows; ++row) {
      const double speed = before[row] + forced * gained[row];
      const double speed_after = after[row] + forced * gained[row];
      work.added += 0.5 * block.impulse[row] * (speed + speed_after);
      work.exchanged += std::abs(block.impulse[row] * speed);
    }
  }
  return work;
}

// Where friction acts or restitutions differ, Newton's law can add energy (Kane and Levinson 1985).
// All e of the impact are then lowered to about the largest share with which it adds none. Without
// rebound an impact never does: its work impulse . (w + w+)/2 is impulse . w+ - impulse . A
// impulse/2, and each row's impulse . w+ <= 0.
bool Simulator::Impl::lower_restitution(Substep& sub, std::span<const InverseMass> masses,
                                        FrameReport& report) {
  constexpr int kMostTrials = 8;
  constexpr double kClose = 1e-4;
  const auto work = [&] {
    impact_solver().find_impulses(sub.rows);
    return work_of_contacts(sub, u_star, sub.u_before, true);
  };
  const ContactWork full = work();
  exchanged += full.exchanged;
  if (!full.adds()) return true;
  double high = 1.0;
  double added_at_high = full.added;
  double low = 0.0;
  double added_at_low = 0.0;
  double share = 0.0;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    copy(u_star, sub.u_before);
    restitution->set_impacts(sub, sub.u_before, share, sub.rows);
    if (!solve_impacts(sub, masses, report)) return false;
    const double added = work().added;
    if (added <= 0.0 || trial == 0) {
      copy(sub.u_before, u_rebounding);
      low = share;
      added_at_low = added;
      if (added >= -kClose * full.exchanged) break;
      if (trial > 1) added_at_high *= 0.5;  // Illinois: the chord of a convex function stays below
    } else {
      high = share;
      added_at_high = added;
    }
    share = low - added_at_low * (high - low) / (added_at_high - added_at_low);
  }
  copy(u_rebounding, sub.u_before);
  lower_to(low);
  return true;
}

// What was struck separates while the other rows of the sub-step stop bodies: together they can add
// energy. Bodies then need not separate. Joints close at the end of the sub-step, so that some work
// is an error of its length.
bool Simulator::Impl::rebounds_add_energy(const Substep& sub) {
  constexpr double kError = 0.005;  // of the energy of the impacts
  if (sub.struck.empty()) return false;
  sub.solver->find_impulses(sub.rows);
  return work_of_contacts(sub, u_rebounding, state.u, false).added > kError * exchanged;
}

}  // namespace substep
