// Rejects a sub-step if it or its frame would exceed the budget.

#include "core/sim/budget.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/solver/small_steps.hpp"

namespace substep {

FrameProgress Simulator::Impl::progress(const Substep& sub, const FrameReport& report) const {
  FrameProgress at;
  at.taken = sub.probing ? 0 : schedule.number() - 1;
  at.left = sub.probing ? 1 : schedule.left();
  at.flops = report.work.flops;
  at.bodies = sub.part->moving.size();
  at.blocks = blocks.size() - first_block;
  return at;
}

bool Simulator::Impl::within_budget(Substep& sub, FrameReport& report) {
  const FrameProgress at = progress(sub, report);
  const double frame = forecast_work(at, settings);
  const double substep = work_beside_solver(at);
  if (frame > budget.work) {
    stop_over_budget(sub, {.work = frame, .budget = budget.work}, report);
  } else if (substep > budget.substep) {
    stop_over_budget(sub, {.work = substep, .budget = budget.substep, .of_substep = true}, report);
  } else {
    sub.limits = limits_of_solve(at, settings, budget);
    return true;
  }
  return false;
}

void Simulator::Impl::refuse_solve(Substep& sub, const SolveReport& solved, FrameReport& report) {
  Overrun over;
  if (solved.memory_needed > 0.0) {
    over.memory = solved.memory_needed;
    over.budget = budget.memory;
  } else {
    const FrameProgress at = progress(sub, report);
    const double times = is_shared(settings) ? at.left : 1.0;
    over.work = forecast_work(at, settings) + times * solved.work_needed;
    over.budget = budget.work;
    if (over.work <= budget.work) {
      over.work = solved.work_needed + work_beside_solver(at);
      over.budget = budget.substep;
      over.of_substep = true;
    }
  }
  const bool direct = settings.solver == SolverKind::kBpp;
  over.iterations = direct ? 0 : iterations_of(settings, sub.dt / scene->frame);
  stop_over_budget(sub, over, report);
}

void Simulator::Impl::stop_over_budget(Substep& sub, Overrun over, FrameReport& report) {
  const RowCounts rows = count_rows(sub.rows);
  over.contacts = rows.contact;
  over.rows = rows.joint + rows.contact + rows.friction + rows.grab;
  over.bodies = static_cast<std::int64_t>(sub.part->moving.size());
  const FrameProgress at = progress(sub, report);
  over.substeps = at.taken + at.left;
  report.status = StepStatus::kOverBudget;
  report.overrun = over;
  drop_rows(sub);  // nothing solves them
  copy(sub.u_start, state.u);
}

}  // namespace substep
