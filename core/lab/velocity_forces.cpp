#include "core/lab/velocity_forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "core/lab/joint_tree.hpp"
#include "core/sim/start.hpp"

namespace substep {

std::optional<EnergyRise> rise_by_velocity_forces(const Scene& scene, double step, double seconds) {
  constexpr double kMostRise = 0.1;  // of the energy exchanged
  constexpr double kLeastSteps = 20.0;
  const auto started = with_start_of_run(std::make_shared<const Scene>(scene));
  if (started == nullptr) return std::nullopt;
  std::optional<JointTree> tree = JointTree::of(*started);
  if (!tree) return std::nullopt;
  const auto steps = static_cast<std::int64_t>(std::ceil(seconds / step));
  const auto period = static_cast<std::int64_t>(std::ceil(std::max(1.0 / step, kLeastSteps)));
  double kinetic = tree->kinetic();
  double lowest = tree->potential();
  double highest = lowest;
  std::optional<double> first;
  double sum = 0.0;
  std::int64_t count = 0;
  for (std::int64_t i = 1; i <= steps; ++i) {
    tree->step_semi_implicit(step);
    const double potential = tree->potential();
    const double now = tree->kinetic();
    const double time = step * static_cast<double>(i);
    if (!std::isfinite(now + potential)) return EnergyRise{time, now, 0.0};
    kinetic = std::max(kinetic, now);
    lowest = std::min(lowest, potential);
    highest = std::max(highest, potential);
    sum += now + potential;
    ++count;
    const bool is_last = i == steps && 2 * count >= period;
    if (count < period && !is_last) continue;
    const double mean = sum / static_cast<double>(count);
    if (!first) first = mean;
    const double limit = kMostRise * std::max(kinetic, highest - lowest);
    if (mean - *first > limit) return EnergyRise{time, mean - *first, limit};
    sum = 0.0;
    count = 0;
  }
  return std::nullopt;
}

}  // namespace substep
