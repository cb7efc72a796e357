#pragma once

#include <string>

namespace substep::cli {

/// Sweeps the shipped scenes and writes the recommended settings for each, within its required
/// error: scenes/generator/recommended.json.
/// @param out file, "-" for standard output
/// @return exit code
int recommend_shipped(const std::string& out, int jobs);

}  // namespace substep::cli
