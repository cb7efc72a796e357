#pragma once
// Results files: one JSON object a line (core/io/result.schema.json). The first line says what the
// file is; every further line is one experiment with its errors, its work and its times.

#include <optional>
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
/// Notes a problem where a line is not such a first line.
void check_results_header(std::string_view line, Problems& problems);

/// One result as a line, without line feed. The part "timing" is this machine's; all else is the
/// same everywhere.
Json result_json(const Result& result);

/// Its parts "work" and "timing".
Json work_json(const Work& work);
Json timing_json(const Timing& timing);

/// Work and times of a run by stage and by row kind, and what each effect adds to a frame.
Json costs_json(const CostBreakdown& costs);

/// The id of a line that has the parts of a result. Notes what is wrong with it otherwise.
std::optional<std::string> result_id(const Json& line, Problems& problems);

}  // namespace substep
