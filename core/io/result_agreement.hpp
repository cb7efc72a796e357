#pragma once

#include "core/io/json.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/problem.hpp"

namespace substep {

/// Adds a problem for fields of a result that contradict each other, each of them valid by itself:
///   - the id, the series and the parameter are those of the settings;
///   - a run either holds, or fails at a time within it, which its verdict names;
///   - frames and the seconds of the run, or up to the failure, have a length that a scene may
///   have;
///   - the sub-steps of the frames add up to at least what their least and most say;
///   - a median or an end is at most the peak.
/// @param line of a results file
void check_result_agreement(const Json& line, const Experiment& experiment, Problems& problems);

}  // namespace substep
