#include "core/sim/simulator.hpp"

#include <limits>

#include "core/sim/simulator_impl.hpp"

namespace substep {

// Giles and Andrews 2024, Algorithm 1: a whole frame, or as much of one as is asked for.
FrameReport Simulator::Impl::advance(int most) {
  if (refused.any()) return refusal();
  if (stopped.status != StepStatus::kOk) return stopped;

  StageClock wall;
  if (!open) begin_frame();  // N = ceil(h / dt_max)                                 Eqs. 9-11
  FrameReport& report = *open;
  while (schedule.running() && most-- > 0) {
    const double dt = schedule.dt();
    watched = most == 0 || schedule.last_of_part();
    begin_substep(report);
    if (!append_rows(report)) break;  // phi, J
    external_forces(dt, report);      // Mt, u* = Mt^-1 (M u + dt f)                      Eqs. 2, 6
    if (!solve(dt, report)) break;    // dt lambda, u+                                    Eq. 3
    if (!finite(report)) break;
    // K, k, r, with the arms that lambda belongs to                                  Eqs. 1, 4, 9
    if (schedule.needs_stiffness() && !evaluate_stiffness(report)) break;
    advance_poses(dt, report);
    schedule.advance(bound.r, r_rotation_again());  // per sub-step: decide again
  }
  return end(wall);
}

FrameReport Simulator::step() { return impl_->advance(std::numeric_limits<int>::max()); }
FrameReport Simulator::substep() { return impl_->advance(1); }
int Simulator::substeps_left() const { return impl_->open ? impl_->schedule.left() : 0; }

}  // namespace substep
