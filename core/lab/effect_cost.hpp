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
  double ms = 0.0;           // wall time, mean of the frames but the extreme ones [ms]
  double flops = 0.0;        // of the solver, mean of the frames
  double row_updates = 0.0;  // of PGS and XPBD, mean of the frames
};

struct CostBreakdown {
  Metrics run;                      // stages, rows by kind and the criterion
  std::vector<EffectCost> effects;  // those of the scene
};

/// Runs an experiment and steps each of its frames again, from the same state and with the same
/// number of sub-steps, once as it is and once without each effect: the motion is the same, so the
/// difference is the effect's own cost, in the direct solver too, where rows of all kinds are
/// eliminated together. Islands with numbers of their own find them again; that bodies share one
/// number because an effect ties them together is part of what it costs. Without contact there is
/// no friction and no restitution. It goes in parts of a single frame, for a page that must stay
/// alive.
class EffectCostRun {
 public:
  /// @param scene as it stands, without the experiment's load and seed
  /// @param budget of a frame, its memory shared by all that are stepped beside each other
  EffectCostRun(const Scene& scene, Experiment experiment, const Budget& budget = {});
  ~EffectCostRun();
  EffectCostRun(const EffectCostRun&) = delete;
  EffectCostRun& operator=(const EffectCostRun&) = delete;

  /// Steps a part of a frame of the run, or of one again. @return false when all is done
  bool advance();
  [[nodiscard]] double progress() const { return run_.progress(); }  ///< 0 to 1
  /// Of the frames so far.
  [[nodiscard]] CostBreakdown costs() const;
  [[nodiscard]] const Experiment& experiment() const { return run_.experiment(); }

 private:
  class Again;

  ExperimentRun run_;
  std::vector<Again> again_;  // the scene as it is, then without each of its effects
  std::size_t next_ = 0;      // of `again_`, from `before_`
  State before_;              // the frame that is stepped again
  Settings same_;             // for as many sub-steps as the run took in it
  bool more_ = true;          // frames of the run
};

/// All of it in one go.
CostBreakdown cost_of_effects(const Scene& scene, const Experiment& experiment);

}  // namespace substep
