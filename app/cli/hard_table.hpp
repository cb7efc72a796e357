#pragma once

namespace substep::cli {

/// Runs the hard set under every setting that could be recommended and prints, as Markdown, what
/// each holds and costs. @param jobs runs at a time; 0: one for each processor
/// @return false where it was cancelled; nothing is printed then
bool print_hard_table(int jobs);

}  // namespace substep::cli
