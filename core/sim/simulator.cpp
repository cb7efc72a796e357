#include "core/sim/simulator.hpp"

#include "core/sim/simulator_impl.hpp"

namespace substep {

FrameReport Simulator::step() {  // Giles and Andrews 2024, Algorithm 1
  Impl& sim = *impl_;
  if (sim.stopped.status != StepStatus::kOk) return sim.stopped;

  FrameReport report;
  StageClock whole_frame;
  if (sim.probe_due()) sim.probe(report);  // the first frame has no lambda yet

  SubstepClock clock(sim.settings, sim.scene->frame,
                     sim.state.r);  // N = ceil(h / dt_max)   Eqs. 9-11
  while (clock.running()) {
    const double dt = clock.dt();
    sim.begin_substep(report);
    sim.append_rows(report);          // phi, J
    sim.external_forces(dt, report);  // Mt, u* = Mt^-1 (M u + dt f)                      Eqs. 2, 6
    sim.solve(dt, false, report);     // lambda, u+                                       Eq. 3
    if (!sim.finite(report)) break;
    if (clock.needs_stiffness()) {
      sim.evaluate_stiffness(
          report);  // K, k, r, with the arms that lambda belongs to   Eqs. 1, 4, 9
    }
    sim.advance_poses(dt, report);
    clock.advance(sim.bound.r);  // per frame: nothing; per sub-step: decide again
  }
  sim.close(clock, report);
  whole_frame.lap(report.times.total);
  return report;
}

}  // namespace substep
