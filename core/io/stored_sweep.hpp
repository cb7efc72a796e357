#pragma once
// The sweep of a shipped scene as text that is shipped with it: what accuracy costs on it is known
// before anybody runs it. Only what is the same on every machine is kept.
//
//   substep-sweep 1 PLAN          the id of the experiments: of another scene or sweep it differs
//   uncertainty window scale      of the reference [m, s, J]
//   its source
//   the source of its scale
//   a line for each experiment, in the order of quick_sweep():
//   substeps operations path energy gap overlap #hash       of a run that holds
//   ! frames substeps operations failed_at verdict #hash    of one that failed
//
// Errors have four digits, and "-" where a scene has none. The hash is of the bits of the final
// state, the work and all errors but that of the path, whose reference depends on the library's
// sine; programs are shipped without it.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/lab/experiment_run.hpp"

namespace substep {

/// What the window sweeps: every method along its own parameter, as long as the motion can be
/// predicted. The curves grow evenly in this order, and the map of loads comes last.
std::vector<Experiment> quick_sweep(const Scene& scene);

/// Of the experiments, in this order.
std::string plan_id(std::span<const Experiment> experiments);

/// @param results of the experiments of a quick_sweep(), one of each and in its order
std::string sweep_text(std::span<const Result> results, const ReferenceSummary& reference);

struct StoredSweep {
  ReferenceSummary reference;
  std::vector<Result> results;
};

/// Nothing where the text is not of the quick_sweep() of this scene as it stands.
std::optional<StoredSweep> read_sweep(std::string_view text, const Scene& scene);

}  // namespace substep
