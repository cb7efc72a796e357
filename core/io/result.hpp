#pragma once
// Results files: one JSON object a line (core/io/result.schema.json). The first line identifies the
// file; every further line is one experiment with errors, work and times.

#include <string>
#include <string_view>

#include "core/io/json.hpp"
#include "core/lab/effect_cost.hpp"
#include "core/lab/experiment_run.hpp"
#include "core/model/problem.hpp"

namespace substep {

inline constexpr int kResultsVersion = 1;

/// The first line of a results file, with its line feed.
std::string results_header();
/// Adds a problem if a line is not a valid first line.
void check_results_header(std::string_view line, Problems& problems);

/// One result as a line, without line feed. Only the part "timing" depends on the machine.
Json result_json(const Result& result);

/// Its parts "work" and "timing".
Json work_json(const Work& work);
Json timing_json(const Timing& timing);

/// Work and times of a run by stage and row kind, and the cost of each effect per frame.
Json costs_json(const CostBreakdown& costs);

}  // namespace substep
