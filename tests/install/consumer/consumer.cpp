// Loads a scene, runs it and measures it: a typical program that uses substep::core.

#include <cstdio>

#include "core/io/experiment.hpp"
#include "core/io/scene_reader.hpp"
#include "core/lab/experiment_run.hpp"

// Compiled here, with the flags of this program, although the library has its own copy.
template substep::Vec3 Eigen::QuaternionBase<substep::Quat>::_transformVector(
    const substep::Vec3&) const;

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const substep::SceneResult loaded = substep::read_scene_file(argv[1]);
  if (!loaded.scene) return 2;
  substep::Experiment experiment = substep::experiment_of(*loaded.scene, loaded.scene->settings);
  experiment.duration = 1.0;
  const substep::Reference reference = substep::find_reference(loaded.scene, experiment.duration);
  substep::ExperimentRun run(*loaded.scene, experiment, reference);
  while (run.advance()) {
  }
  const substep::Metrics metrics = run.result().metrics;
  std::printf("%s %s %.17g m\n", substep::hex_text(metrics.hash).c_str(), reference.source.c_str(),
              metrics.errors.trajectory_peak.value_or(-1.0));
  return metrics.holds ? 0 : 1;
}
