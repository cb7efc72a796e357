#pragma once

#include <string>

namespace substep::cli {

/// Runs experiments, one JSON object per line, and prints one result per line as each completes.
/// @param path file, or "-" for standard input
/// @param scene name or file of the scene used by the experiments; "": shipped scenes
/// @return exit code; an invalid line is reported on stderr and the others still run
int run_experiments(const std::string& path, const std::string& scene);

}  // namespace substep::cli
