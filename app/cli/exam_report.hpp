#pragma once
// The exam's results as a table, as JSON and as a page.

#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/lab/exam.hpp"

namespace substep::cli {

/// A case and its result.
struct ExamOutcome {
  const ExamEntry* entry = nullptr;
  ExamCase exam;
  ExamResult result;
};

/// "passes", or "fails: ..." with the reason.
std::string verdict_of(const ExamOutcome& outcome);

/// Prints a case with its tolerances and all runs to standard output.
void print_case(const ExamOutcome& outcome);
/// Prints a line per case, and the number of passes.
void print_summary(const std::vector<ExamOutcome>& outcomes);

Json exam_json(const std::vector<ExamOutcome>& outcomes);
/// A self-contained HTML page: tables with a bar for every error, no script.
std::string exam_page(const std::vector<ExamOutcome>& outcomes);

}  // namespace substep::cli
