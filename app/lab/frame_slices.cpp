#include "app/lab/frame_slices.hpp"

#include "core/lab/slice.hpp"

namespace substep {

std::optional<FrameReport> FrameSlices::advance(Simulator& simulator, Clock::time_point until) {
  if (!open()) start_ = simulator.state();
  while (true) {
    const FrameReport report = simulator.step_some(kPartWork);
    left_ = report.status == StepStatus::kOk ? simulator.substeps_left() : 0;
    if (left_ == 0) {
      taken_ = 0;
      frame_time_ = report.times.total;
      return report;
    }
    taken_ = report.n_substeps;
    if (Clock::now() >= until) return std::nullopt;
  }
}

void FrameSlices::drop(Simulator& simulator) {
  if (!open()) return;
  taken_ = left_ = 0;
  simulator.set_state(start_);
}

FrameSlices::Clock::time_point end_of_slice(double seconds) {
  using Clock = FrameSlices::Clock;
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace substep
