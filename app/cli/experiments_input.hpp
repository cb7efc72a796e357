#pragma once

#include <string>

namespace substep::cli {

/// Runs experiments that come one JSON object a line and prints one result a line, as each is done.
/// @param path file, or "-" for standard input
/// @param scene name or file of the scene that the experiments name; "" finds shipped ones
/// @return exit code; a line that is wrong is told on stderr and the others run all the same
int run_experiments(const std::string& path, const std::string& scene);

}  // namespace substep::cli
