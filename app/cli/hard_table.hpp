#pragma once

namespace substep::cli {

/// Runs the hard set with every setting that could be recommended and prints the verdicts and costs
/// as Markdown. @param jobs parallel runs; 0: one per processor
/// @return false if cancelled; nothing is printed in that case
bool print_hard_table(int jobs);

}  // namespace substep::cli
