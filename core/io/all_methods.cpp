#include "core/io/all_methods.hpp"

#include <set>
#include <string>

#include "core/io/experiment.hpp"
#include "core/lab/sweep.hpp"

namespace substep {

std::vector<Experiment> all_methods(const Scene& scene, double seconds, bool defaults) {
  std::vector<SweepPoint> points = default_sweep(scene);
  if (points.empty()) return {};
  if (defaults) append_defaults(points);
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.duration = seconds;
  std::vector<Experiment> experiments;
  std::set<std::string> known;
  for (const SweepPoint& point : points) {
    if (point.load != 1.0) continue;
    experiment.settings = point.settings;
    if (known.insert(experiment_id(experiment)).second) experiments.push_back(experiment);
  }
  return experiments;
}

}  // namespace substep
