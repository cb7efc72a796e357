#pragma once
// Reads the results of a file (core/io/result.hpp). A result may come from anywhere: every field is
// checked as strictly as those of a scene.

#include <optional>

#include "core/io/json.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/problem.hpp"

namespace substep {

/// The experiment of a result. Adds a problem for every field that is missing, unknown, of another
/// type or out of its range; and if fields contradict each other: the id, series and parameter
/// must be those of the settings. @return nothing if there is a problem
std::optional<Experiment> read_result(const Json& line, Problems& problems);

}  // namespace substep
