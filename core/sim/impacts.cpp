// Propagation of impacts between bodies within a sub-step.

#include <algorithm>
#include <cmath>

#include "core/sim/lower_restitution.hpp"
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
  const bool sweeps = sweeps_motion(sub);
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
  const std::span<const InverseMass> masses = masses_of_impacts(sub);
  for (const int body : sub.part->moving) state.u[index(body)] -= sub.u_before[index(body)];
  if (sweeps) copy(u_star, sub.u_before);
  // Impacts among many bodies can continue indefinitely at decreasing speed. After this many passes
  // the rest is resolved at once, as a single impact, or along the motion without a rebound.
  constexpr int kMostImpacts = 200;
  for (int i = 0; restitution->set_impacts(sub, sub.u_before, 1.0, sub.rows) && i < kMostImpacts;
       ++i) {
    if (sweeps) copy(sub.u_before, u_star);
    if (!solve_impacts(sub, sub.rows, sub.u_before, masses, report)) return false;
    if (!sweeps) continue;
    if (!lower_impacts(sub, masses, report)) return false;
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

// No time passes: no damping or geometric stiffness.
std::span<const InverseMass> Simulator::Impl::masses_of_impacts(const Substep& sub) {
  if (!changes_mass(settings.mode)) return sub.inverse_mass;
  rigid_mass.resize(sub.inverse_mass.size());
  inverse_mass(sub.inertia_inverse, *sub.part, sub.R_WB, rigid_mass);
  return rigid_mass;
}

bool Simulator::Impl::solve_impacts(Substep& sub, std::span<Block> rows, std::span<Vec6> u,
                                    std::span<const InverseMass> masses, FrameReport& report) {
  System system{rows, masses, u, {}, sub.dt, sub.R_WB, scene->regularisation};
  system.limits = limits_of_solve(sub, report);
  system.contacts_yield = sweeps_motion(sub);
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
ContactWork Simulator::Impl::work_of_contacts(const Substep& sub, std::span<const Block> rows,
                                              std::span<const Vec6> u, std::span<const Vec6> u_plus,
                                              bool along_motion) const {
  ContactWork work;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Block& block = rows[i];
    if (!block.is_unilateral()) continue;  // joints that hold do no work
    double before[kMaxRows];
    double after[kMaxRows];
    double gained[kMaxRows] = {};
    row_speeds(block, u, before);
    row_speeds(block, u_plus, after);
    double forced = 0.0;
    if (along_motion) {  // when the contact closes
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

bool Simulator::Impl::lower_impacts(Substep& sub, std::span<const InverseMass> masses,
                                    FrameReport& report) {
  const auto work = [&] {
    report.work.flops += impact_solver().find_impulses(sub.rows);
    return work_of_contacts(sub, sub.rows, u_star, sub.u_before, true);
  };
  const auto solve = [&](double share) {
    copy(u_star, sub.u_before);
    restitution->set_impacts(sub, sub.u_before, share, sub.rows);
    return solve_impacts(sub, sub.rows, sub.u_before, masses, report);
  };
  const ContactWork full = work();
  exchanged += full.exchanged;
  if (!full.adds()) return true;
  const auto share = lower_restitution(full, solve, work, sub.u_before, u_rebounding);
  if (share) lower_to(*share);
  return share.has_value();
}

// What was struck separates while the other rows of the sub-step stop bodies: together they can add
// energy. Bodies then need not separate. Joints close at the end of the sub-step, so that some work
// is an error of its length.
bool Simulator::Impl::rebounds_add_energy(const Substep& sub) {
  constexpr double kError = 0.005;  // of the energy of the impacts
  if (sub.struck.empty()) return false;
  sub.solver->find_impulses(sub.rows);
  return work_of_contacts(sub, sub.rows, u_rebounding, state.u, false).added > kError * exchanged;
}

}  // namespace substep
