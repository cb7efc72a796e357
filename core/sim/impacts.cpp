// Propagation of impacts between bodies within a sub-step.

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
// its energy. Impacts are therefore resolved in passes within the sub-step, all pending ones
// simultaneously and without forces, until none is left. This conserves energy for e = 1 and
// preserves symmetry (Smith et al., Reflections on simultaneous impact, 2012).
bool Simulator::Impl::propagate_impacts(Substep& sub, FrameReport& report) {
  if (!restitution || sub.probing) return true;
  const bool sweeps = sweeps_contacts(sub);
  const bool spreads = restitution->spreads(sub, sub.u_before, sub.rows);
  sub.struck = restitution->struck();
  if (!spreads) return true;
  std::span<const InverseMass> masses = sub.inverse_mass;
  if (changes_mass(settings.mode)) {  // no time passes: no damping or geometric stiffness
    rigid_mass.resize(sub.inverse_mass.size());
    inverse_mass(sub.inertia_inverse, *sub.part, sub.R_WB, rigid_mass);
    masses = rigid_mass;
  }
  for (const int body : sub.part->moving) state.u[index(body)] -= sub.u_before[index(body)];
  // Impacts among many bodies can continue indefinitely at decreasing speed. After this many passes
  // the rest is resolved at once, as a single impact.
  constexpr int kMostImpacts = 200;
  for (int i = 0; restitution->set_impacts(sub, sub.u_before, sub.rows) && i < kMostImpacts; ++i) {
    if (sweeps) copy(sub.u_before, u_star);
    System system{sub.rows, masses, sub.u_before, {}, sub.dt, sub.R_WB, scene->regularisation};
    system.limits = limits_of_solve(sub, report);
    const SolveReport solved = impact_solver().find_velocities(system, settings);
    if (solved.status == SolveStatus::kOverLimits) {
      refuse_solve(sub, solved, report);
      return false;
    }
    count_work(sub, solved, report);
    ++report.work.impacts;
    if (!sweeps) continue;
    // The impulse moves the bodies only from the time of the impact on.
    for (const int body : sub.part->moving) {
      shift[index(body)] -= restitution->late() * (sub.u_before[index(body)] - u_star[index(body)]);
    }
  }
  for (const int body : sub.part->moving) state.u[index(body)] += sub.u_before[index(body)];
  return true;
}

}  // namespace substep
