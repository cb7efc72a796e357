#pragma once
// The precomputed sweep of a shipped scene as text: error against cost without running it. Only
// machine-independent values are stored.
//
//   substep-sweep 1 PLAN          id of the experiments, unique to scene and sweep
//   uncertainty window scale      of the reference [m, s, J]
//   its source
//   the source of its scale
//   a line for each experiment, in the order of quick_sweep():
//   substeps operations path energy gap overlap #hash       for a run that holds
//   ! frames substeps operations failed_at verdict #hash    for a failed run
//
// Errors have four digits, or "-" if undefined for the scene. The hash covers the bits of the final
// state, the work and all errors except the path's, whose reference depends on the library's sine;
// it is omitted from shipped programs.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

/// The experiments of the window's sweep: every method along its parameter, over the predictable
/// time of the motion. Ordered so that all curves grow evenly; the map of loads comes last.
std::vector<Experiment> quick_sweep(const Scene& scene);

/// @param results results of all experiments of a quick_sweep(), in its order
std::string sweep_text(std::span<const Result> results, const ReferenceSummary& reference);

struct StoredSweep {
  ReferenceSummary reference;
  std::vector<Result> results;
};

/// Nothing if the text does not match the quick_sweep() of this scene.
std::optional<StoredSweep> read_sweep(std::string_view text, const Scene& scene);

}  // namespace substep
