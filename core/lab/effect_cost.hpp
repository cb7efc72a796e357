#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

/// What an effect adds to a frame: the frame as it is, less the same frame without the effect.
/// Negative where the effect spares more than it takes.
struct EffectCost {
  std::string_view effect;   // as scene files name it
  double ms = 0.0;           // wall time, median of the frames [ms]
  double flops = 0.0;        // of the solver, mean of the frames
  double row_updates = 0.0;  // of PGS, mean of the frames
};

struct CostBreakdown {
  Metrics run;                      // stages, rows by kind and the criterion
  std::vector<EffectCost> effects;  // those of the scene
};

/// Runs an experiment and steps each of its frames again, from the same state and with the same
/// number of sub-steps, once as it is and once without each effect: the motion is the same, so the
/// difference is the effect's own cost, in the direct solver too, where rows of all kinds are
/// eliminated together. Without contact there is no friction and no restitution.
/// @param scene as it stands, without the experiment's load and seed
CostBreakdown cost_of_effects(const std::shared_ptr<const Scene>& scene,
                              const Experiment& experiment);

}  // namespace substep
