#include "core/sim/simulator.hpp"

#include "core/sim/simulator_impl.hpp"

namespace substep {

// Giles and Andrews 2024, Algorithm 1: a whole frame, or the requested share.
FrameReport Simulator::Impl::advance(Share share) {
  if (refused.any()) return refusal();
  if (stopped.status != StepStatus::kOk) return stopped;

  StageClock wall;
  if (!open) begin_frame();  // N = ceil(h / dt_max)                                 Eqs. 9-11
  FrameReport& report = *open;
  for (double spent = 0.0; schedule.running() && share.most-- > 0 && spent < share.work;) {
    const std::int64_t before = report.work.flops;
    Substep& sub = begin_substep(share.most == 0, report);
    if (!append_rows(sub, report)) break;  // phi, J
    external_forces(sub, report);          // Mt, u* = Mt^-1 (M u + dt f)                 Eqs. 2, 6
    if (!solve(sub, report)) break;        // dt lambda, u+                               Eq. 3
    if (!finite(sub, report)) break;
    keep_forces(sub);
    // K, k, r, with the arms matching lambda                                         Eqs. 1, 4, 9
    if (schedule.clock().needs_stiffness() && !evaluate_stiffness(sub, report)) break;
    advance_poses(sub, report);
    spent += static_cast<double>(report.work.flops - before) + work_beside_solver(sub);
    schedule.advance(bound.r, watch_substep(sub));  // re-evaluates N with policy substep
    // With a larger N. What follows joints that did not close means nothing.
    if ((!schedule.running() || joints_open) && schedule.exceeded()) begin_again(report);
  }
  return end(wall, share.whole());
}

FrameReport Simulator::step() { return impl_->advance({}); }
FrameReport Simulator::substep() { return impl_->advance({.most = 1}); }
FrameReport Simulator::step_some(double work) { return impl_->advance({.work = work}); }
int Simulator::substeps_left() const { return impl_->open ? impl_->schedule.left() : 0; }

}  // namespace substep
