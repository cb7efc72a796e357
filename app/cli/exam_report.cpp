#include "app/cli/exam_report.hpp"

#include <cmath>
#include <cstdio>

#include "app/cli/message.hpp"
#include "core/model/format_text.hpp"

namespace substep::cli {
namespace {

/// Method, parameter and value: "leapfrog, n = 64".
std::string run_name(const ExamRow& row) {
  return format_text("%s, %s = %g", row.method.c_str(), row.parameter.c_str(), row.value);
}

/// The case's best run and its worst quantity relative to its tolerance.
std::string best_text(const ExamOutcome& outcome) {
  const ExamRow& best = outcome.result.rows[outcome.result.best(outcome.exam)];
  if (!best.status.empty()) return "every run fails: " + best.status;
  std::size_t worst = 0;
  const auto share = [&](std::size_t i) {
    return best.errors[i] / outcome.exam.quantities[i].tolerance;
  };
  for (std::size_t i = 1; i < best.errors.size(); ++i) {
    if (share(i) > share(worst)) worst = i;
  }
  const ExamQuantity& quantity = outcome.exam.quantities[worst];
  return format_text("%s: %s %.2g of %.2g %s", run_name(best).c_str(), quantity.name.c_str(),
                     best.errors[worst], quantity.tolerance, quantity.unit.c_str());
}

/// The failed requirements, with the names of the methods that fail them.
std::string broken_text(const ExamOutcome& outcome) {
  std::string text;
  for (const ExamRow& row : outcome.result.rows) {
    if (row.keeps) continue;
    text += text.empty() ? "" : ", ";
    if (row.expected_order && row.order && *row.order < *row.expected_order - kOrderAllowance) {
      text += format_text("%s has order %.1f, not %g", row.method.c_str(), *row.order,
                          *row.expected_order);
      continue;
    }
    for (std::size_t i = 0; i < row.within.size(); ++i) {
      const ExamQuantity& quantity = outcome.exam.quantities[i];
      if (!quantity.for_every_run || row.within[i]) continue;
      text +=
          format_text("%s: %s %.2g", run_name(row).c_str(), quantity.name.c_str(), row.errors[i]);
    }
  }
  return text;
}

}  // namespace

std::string verdict_of(const ExamOutcome& outcome) {
  if (outcome.result.passed()) return "passes";
  std::string text = "fails: ";
  if (!outcome.result.reached) text += "no run is within the tolerances";
  if (!outcome.result.reached && !outcome.result.kept) text += "; ";
  return text + broken_text(outcome);
}

void print_case(const ExamOutcome& outcome) {
  say(stdout, "%s: %s\n", outcome.entry->name.c_str(), outcome.entry->title.c_str());
  const ExamCase& exam = outcome.exam;
  say(stdout, "  %s\n  From %s.\n", exam.definition.c_str(), exam.source.c_str());
  for (std::size_t i = 0; i < exam.quantities.size(); ++i) {
    const ExamQuantity& quantity = exam.quantities[i];
    say(stdout, "  [%zu] %s <= %.2g %s%s: %s\n", i + 1, quantity.name.c_str(), quantity.tolerance,
        quantity.unit.c_str(), quantity.for_every_run ? " in every run" : "", quantity.why.c_str());
  }
  say(stdout, "  %-16s %12s %9s", "method", "", "sub-steps");
  for (std::size_t i = 0; i < exam.quantities.size(); ++i) say(stdout, "       [%zu]", i + 1);
  say(stdout, "   order  time [s]\n");
  for (const ExamRow& row : outcome.result.rows) {
    const std::string parameter = format_text("%s %g", row.parameter.c_str(), row.value);
    say(stdout, "  %-16s %12s %9.1f", row.method.c_str(), parameter.c_str(), row.substeps);
    for (std::size_t i = 0; i < row.errors.size(); ++i) {
      say(stdout, " %8.1e%c", row.errors[i], row.within[i] ? '*' : ' ');
    }
    const std::string order = row.order ? format_text("%.2f", *row.order) : "-";
    say(stdout, " %6s%c %9.2f  %s\n", order.c_str(), row.keeps ? ' ' : '!', row.seconds,
        row.status.c_str());
  }
  say(stdout, "  %s\n\n", verdict_of(outcome).c_str());
  std::fflush(stdout);
}

void print_summary(const std::vector<ExamOutcome>& outcomes) {
  std::size_t passed = 0;
  for (const ExamOutcome& outcome : outcomes) {
    passed += outcome.result.passed() ? 1U : 0U;
    std::string text = outcome.result.passed() ? "passes  " : "FAILS   ";
    text += outcome.result.passed() || !outcome.result.reached ? best_text(outcome) : "";
    if (!outcome.result.kept) {
      text += (outcome.result.reached ? "" : "; ") + broken_text(outcome);
    }
    say(stdout, "%-16s %s\n", outcome.entry->name.c_str(), text.c_str());
  }
  say(stdout, "%zu of %zu cases pass\n", passed, outcomes.size());
}

Json exam_json(const std::vector<ExamOutcome>& outcomes) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  Json list = Json::array();
  for (const ExamOutcome& outcome : outcomes) {
    Json json{{"case", outcome.entry->name},
              {"title", outcome.entry->title},
              {"verdict", verdict_of(outcome)}};
    json["passes"] = outcome.result.passed();
    json["definition"] = outcome.exam.definition;
    json["source"] = outcome.exam.source;
    json["best"] = best_text(outcome);
    for (const ExamQuantity& quantity : outcome.exam.quantities) {
      json["quantities"].push_back({{"name", quantity.name},
                                    {"unit", quantity.unit},
                                    {"tolerance", quantity.tolerance},
                                    {"why", quantity.why},
                                    {"for_every_run", quantity.for_every_run}});
    }
    for (const ExamRow& row : outcome.result.rows) {
      Json one{{"method", row.method},     {"parameter", row.parameter}, {"value", row.value},
               {"substeps", row.substeps}, {"passes", row.passes},       {"keeps", row.keeps},
               {"within", row.within},     {"status", row.status},       {"seconds", row.seconds}};
      one["errors"] = Json::array();
      for (const double error : row.errors) one["errors"].push_back(number(error));
      one["order"] = row.order ? number(*row.order) : Json();
      one["expected_order"] = row.expected_order ? number(*row.expected_order) : Json();
      json["runs"].push_back(std::move(one));
    }
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace substep::cli
