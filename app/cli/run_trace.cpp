#include "app/cli/run_trace.hpp"

#include <numeric>

#include "core/lab/verdict.hpp"
#include "core/sim/simulator.hpp"

namespace substep::cli {

double RunTrace::total_substeps() const {
  return std::accumulate(substeps.begin(), substeps.end(), 0.0);
}

RunTrace trace_run(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                   double duration) {
  Simulator simulator(scene);
  simulator.set_settings(settings);
  RunTrace trace;
  FrameReport report = simulator.observe();
  Verdict verdict(*scene, simulator.state(), report);
  const auto note = [&] {
    trace.time.push_back(report.time);
    trace.substeps.push_back(report.n_substeps);
    trace.kinetic.push_back(report.kinetic);
    trace.energy.push_back(report.energy);
    trace.constraint_error.push_back(report.constraint_error);
    trace.joint_gap.push_back(report.joint_gap);
    if (scene->criteria.track) {
      const auto tracked = static_cast<std::size_t>(*scene->criteria.track);
      trace.height.push_back(simulator.state().x[tracked].y());
    }
  };
  note();
  const std::int64_t frames = frames_of(*scene, duration);
  for (std::int64_t i = 0; i < frames && verdict.holds(); ++i) {
    report = simulator.step();
    verdict.add(*scene, simulator.state(), report);
    note();
  }
  trace.holds = verdict.holds();
  trace.failed_at = verdict.failed_at();
  trace.verdict = verdict.text();
  return trace;
}

}  // namespace substep::cli
