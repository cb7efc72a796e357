#pragma once
// The exam's results as a table, as JSON and as a page.

#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/lab/exam.hpp"

namespace substep::cli {

/// A case and what came of it. Exam and result are empty where the vocabulary does not reach it.
struct ExamOutcome {
  const ExamEntry* entry = nullptr;
  ExamCase exam;
  ExamResult result;
  [[nodiscard]] bool reached_by_vocabulary() const { return entry->not_reached.empty(); }
};

/// "passes", "fails: ..." with what failed, or "not reached: needs springs".
std::string verdict_of(const ExamOutcome& outcome);

/// A case with its tolerances and every run, on standard output.
void print_case(const ExamOutcome& outcome);
/// A line for each case, and how many pass.
void print_summary(const std::vector<ExamOutcome>& outcomes);

Json exam_json(const std::vector<ExamOutcome>& outcomes);
/// One HTML file that opens without a network: tables with a bar for every error, no script.
std::string exam_page(const std::vector<ExamOutcome>& outcomes);

}  // namespace substep::cli
