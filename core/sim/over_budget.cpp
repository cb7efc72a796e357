// Predicts the cost of a frame before each of its sub-steps, and rejects a sub-step if it or its
// frame would exceed the budget. Costs are in operations.

#include <algorithm>

#include "core/sim/simulator_impl.hpp"
#include "core/solver/small_steps.hpp"

namespace substep {
namespace {

constexpr double kBodyWork = 200.0;    // per body: external forces, masses, pose
constexpr double kBlockWork = 1000.0;  // per joint or contact: detection, rows, storage, report
constexpr int kTypical = 16;           // sub-steps whose mean predicts the others

double work_of_bodies(const Substep& sub) {
  return kBodyWork * static_cast<double>(sub.part->moving.size());
}

}  // namespace

int Simulator::Impl::substeps_taken(const Substep& sub) const {
  return sub.probing ? 0 : schedule.clock().taken();
}

int Simulator::Impl::substeps_left(const Substep& sub) const {
  return sub.probing ? 1 : schedule.left();
}

double Simulator::Impl::work_beside_solver(const Substep& sub) const {
  return work_of_bodies(sub) + kBlockWork * static_cast<double>(blocks.size() - first_block);
}

// Moving bodies, plus the direct solver at its mean cost per sub-step so far. Sweeps are excluded:
// the solver counts their work exactly.
double Simulator::Impl::forecast_work(const Substep& sub, const FrameReport& report) const {
  const auto done = static_cast<double>(report.work.flops);
  const int taken = substeps_taken(sub);
  const int left = substeps_left(sub);
  double to_come = work_of_bodies(sub) * left;
  if (!entry_of(settings.solver).sweeps && taken >= kTypical) to_come += done / taken * left;
  return done + to_come;
}

// Sweeps recur in every sub-step, so the remaining budget is shared among them. A direct solve may
// use all of it.
SolveLimits Simulator::Impl::limits_of_solve(const Substep& sub, const FrameReport& report) const {
  const int steps = substeps_left(sub);
  const double left =
      budget.work - static_cast<double>(report.work.flops) - work_of_bodies(sub) * steps;
  const double in_frame = entry_of(settings.solver).sweeps ? left / steps : left;
  return {budget.memory, std::min(in_frame, budget.substep - work_beside_solver(sub))};
}

bool Simulator::Impl::within_budget(Substep& sub, FrameReport& report) {
  const double frame = forecast_work(sub, report);
  const double substep = work_beside_solver(sub);
  if (frame > budget.work) {
    stop_over_budget(sub, {.work = frame, .budget = budget.work}, report);
  } else if (substep > budget.substep) {
    stop_over_budget(sub, {.work = substep, .budget = budget.substep, .of_substep = true}, report);
  } else {
    sub.limits = limits_of_solve(sub, report);
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
    // A solver that sweeps costs the same in every sub-step.
    const double times = entry_of(settings.solver).sweeps ? substeps_left(sub) : 1.0;
    over.work = forecast_work(sub, report) + times * solved.work_needed;
    over.budget = budget.work;
    if (over.work <= budget.work) {
      over.work = solved.work_needed + work_beside_solver(sub);
      over.budget = budget.substep;
      over.of_substep = true;
    }
  }
  const bool direct = entry_of(settings.solver).iterations == 0;
  over.iterations = direct ? 0 : iterations_of(settings, sub.dt / scene->frame);
  stop_over_budget(sub, over, report);
}

void Simulator::Impl::stop_over_budget(Substep& sub, Overrun over, FrameReport& report) {
  const RowCounts rows = count_rows(sub.rows);
  over.contacts = rows.contact;
  over.rows = rows.joint + rows.contact + rows.friction + rows.grab;
  over.bodies = static_cast<std::int64_t>(sub.part->moving.size());
  over.substeps = substeps_taken(sub) + substeps_left(sub);
  report.status = StepStatus::kOverBudget;
  report.overrun = over;
  drop_rows(sub);  // nothing solves them
  copy_of(sub.part->bodies, sub.u_start, state.u);
}

}  // namespace substep
