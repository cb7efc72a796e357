#pragma once

#include <string>

namespace substep::cli {

/// Sweeps the shipped scenes and writes what is recommended for each within the error that is
/// wanted of it: scenes/generator/recommended.json.
/// @param out file, - for standard output
/// @return main()'s
int recommend_shipped(const std::string& out, int jobs);

}  // namespace substep::cli
