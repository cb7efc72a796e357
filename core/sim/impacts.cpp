// Impacts that pass from body to body within a sub-step.

#include "core/sim/simulator_impl.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/mode_rules.hpp"

namespace substep {

namespace {

// Impacts among many bodies can go on for ever, ever more slowly. What is left after these rebounds
// at once, as an impact alone does.
constexpr int kMostImpacts = 200;

SolverKind impact_solver(SolverKind chosen) {
  return chosen == SolverKind::kPgs ? SolverKind::kPgs : SolverKind::kBpp;
}

}  // namespace

// Newton's law of restitution looks at speeds before the impact. Where an impact sets a body
// against another one that it touches, nothing of that is known before: a ball that strikes a row
// of balls would carry the whole row away, and lose most of its energy. So impacts follow one
// another in the sub-step, all that are due at once, without forces, until none is left: that loses
// nothing where e = 1, and keeps what is symmetric so (Smith et al., Reflections on simultaneous
// impact, 2012).
bool Simulator::Impl::propagate_impacts(double dt, FrameReport& report) {
  const std::span<Block> own = rows();
  if (!restitution->spreads(*scene, u_before, dt, own)) return true;
  if (!impacts) impacts = make_solver(impact_solver(settings.solver));
  std::span<const InverseMass> masses = inverse_mass;
  if (changes_mass(settings.mode)) {  // no time passes: nothing is damped or resists turning
    rigid_mass.resize(inverse_mass.size());
    substep::inverse_mass(inertia_inverse, part(), R_WB, rigid_mass);
    masses = rigid_mass;
  }
  for (const int body : part().moving) state.u[index(body)] -= u_before[index(body)];
  for (int i = 0; restitution->set_impacts(*scene, u_before, dt, own) && i < kMostImpacts; ++i) {
    System system{own, masses, u_before, {}, dt, R_WB, scene->regularisation};
    system.limits = limits_of_solve(progress(report), settings, budget);
    const SolveReport solved = impacts->find_velocities(system, settings);
    if (solved.status == SolveStatus::kOverLimits) {
      refuse_solve(solved, dt, report);
      return false;
    }
    count_work(solved, report);
    ++report.work.impacts;
  }
  for (const int body : part().moving) state.u[index(body)] += u_before[index(body)];
  return true;
}

}  // namespace substep
