#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/exam_report.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/progress_line.hpp"
#include "app/cli/within.hpp"
#include "core/io/object_reader.hpp"
#include "scenes/generator/exam.hpp"

namespace substep::cli {
namespace {

struct ExamOptions {
  std::vector<std::string> cases;
  bool list = false;
  bool quiet = false;
  std::string json;
  std::string html;
};

int list_cases() {
  for (const ExamEntry& entry : scenes::exam()) {
    say(stdout, "%-16s %s\n", entry.name.c_str(), entry.title.c_str());
  }
  return kOk;
}

/// The entries with these names, or all without names. Reports unknown names on stderr.
bool select(const std::vector<std::string>& names, std::vector<const ExamEntry*>& selected) {
  const std::vector<ExamEntry>& all = scenes::exam();
  bool known = true;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const ExamEntry& entry) { return entry.name == name; });
    if (found != all.end()) {
      selected.push_back(&*found);
      continue;
    }
    known = false;
    std::vector<std::string_view> candidates;
    candidates.reserve(all.size());
    for (const ExamEntry& entry : all) candidates.push_back(entry.name);
    complain("%s: no such case%s; `substep exam --list` lists the cases", name.c_str(),
             did_you_mean(name, candidates).c_str());
  }
  if (names.empty()) {
    for (const ExamEntry& entry : all) selected.push_back(&entry);
  }
  return known;
}

std::vector<ExamOutcome> run_cases(const std::vector<const ExamEntry*>& entries, bool quiet) {
  ProgressLine progress(!quiet && stderr_is_terminal());
  std::vector<ExamOutcome> outcomes;
  for (const ExamEntry* entry : entries) {
    ExamOutcome outcome{.entry = entry, .exam = {}, .result = {}};
    outcome.exam = entry->build();
    outcome.result = run_exam(
        outcome.exam, [&](const ExamRow& row) { progress.show(entry->name + ": " + row.method); });
    progress.clear();
    if (!quiet) print_case(outcome);
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

int run(const ExamOptions& options) {
  std::vector<const ExamEntry*> entries;
  if (!select(options.cases, entries)) return kBadInput;
  Output json;
  Output html;
  if (!json.open(options.json) || !html.open(options.html)) return kBadInput;
  const bool on_stdout = is_standard_output(options.json) || is_standard_output(options.html);
  const std::vector<ExamOutcome> outcomes = run_cases(entries, options.quiet || on_stdout);
  if (!on_stdout) print_summary(outcomes);
  if (json.is_open()) json.write(exam_json(outcomes).dump(2) + "\n");
  if (html.is_open()) html.write(exam_page(outcomes));
  const bool written = json.close();
  if (!html.close() || !written) return kBadInput;
  for (const ExamOutcome& outcome : outcomes) {
    if (!outcome.result.passed()) return kUnexpectedVerdict;
  }
  return kOk;
}

}  // namespace

void add_exam(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExamOptions>();
  CLI::App* command =
      app.add_subcommand("exam", "Run cases with published answers or a closed form");
  auto* list = command->add_flag("--list", options->list, "list the cases and run nothing");
  command->add_option("--case", options->cases, "only these cases")->excludes(list);
  command->add_option("--json", options->json, "write every run as JSON; - for standard output")
      ->check(named())
      ->excludes(list);
  command->add_option("--html", options->html, "write a page with every run")
      ->check(named())
      ->excludes(list);
  command->add_flag("--quiet", options->quiet, "print the summary only")->excludes(list);
  command->footer(
      "A case passes if at least one run is within all of its tolerances, and every run meets the\n"
      "requirements on all runs: the order of its method, and those of the case. Columns: method;\n"
      "n or alpha; mean sub-steps per frame; an error for each quantity, with * if it is within\n"
      "its tolerance; observed order of the first quantity relative to the previous run, with !\n"
      "if it is below that of the method; wall time. Exit code 1 if a case fails.\n"
      "Example:\n  substep exam --case revolute --html revolute.html");
  command->callback([options, &exit_code] {
    keep_apart({{"--json", options->json}, {"--html", options->html}}, {});
    exit_code = options->list ? list_cases() : run(*options);
  });
}

}  // namespace substep::cli
