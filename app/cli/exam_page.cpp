// The exam as a page: plain HTML in the style of the other reports (app/report/report.css), without
// a script.

#include <algorithm>
#include <cmath>

#include "app/cli/exam_report.hpp"
#include "core/io/xml_text.hpp"
#include "core/model/format_text.hpp"

namespace substep::cli {
namespace {

constexpr const char* kExamHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<title>The exam</title>
<style>
:root { color-scheme: light; --ground: #ffffff; --well: #f4f6f9; --border: #d5dbe4; --text: #161b24;
  --dim: #556072; --orange: #c9480b; --teal: #0b7a5e; --grey: #6b7586; }
@media (prefers-color-scheme: dark) { :root { color-scheme: dark; --ground: #14181f; --well: #1b2029;
  --border: #343c4a; --text: #e8ecf2; --dim: #9aa4b3; --orange: #ff8a4c; --teal: #46c6a0;
  --grey: #7d8798; } }
body { margin: 0; background: var(--ground); color: var(--text);
  font: 15px/1.5 Inter, system-ui, sans-serif; }
main { max-width: 1140px; margin: 0 auto; padding: 24px 20px 64px; }
h1 { font-size: 24px; font-weight: 600; margin: 0; }
h2 { font-size: 18px; font-weight: 600; margin: 0 0 4px; }
p { margin: 6px 0; max-width: 76ch; }
.note, .stamp, li { color: var(--dim); font-size: 13px; }
.claim { margin: 36px 0 0; border-left: 4px solid var(--grey); padding-left: 16px; }
.claim.passes { border-color: var(--teal); }
.claim.fails { border-color: var(--orange); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums;
  margin-top: 10px; }
th, td { text-align: left; padding: 5px 14px 5px 0; border-bottom: 1px solid var(--border);
  white-space: nowrap; font-weight: 400; }
thead th { color: var(--dim); vertical-align: bottom; }
.bar { display: block; width: 110px; height: 5px; border-radius: 3px; background: var(--well); }
.bar i { display: block; height: 5px; border-radius: 3px; background: var(--grey); }
.within .bar i { background: var(--teal); }
.broken { color: var(--orange); }
a { color: inherit; }
</style>
<body>
<main>
<h1>The exam: published results</h1>
<p>Scenes with published results or a closed-form solution. A case passes if at least one run is
within all of its tolerances, and every run keeps the order of its method and the limits that the
case sets for all runs. Bars are logarithmic: a full bar is a million times the tolerance, an empty
bar a thousandth; green bars are within it.</p>
)";

const char* css_class(const ExamOutcome& outcome) {
  return outcome.result.passed() ? "passes" : "fails";
}

/// Length of an error's bar, from 1e-3 to 1e6 times the tolerance [%].
double bar_length(double error, double tolerance) {
  if (!std::isfinite(error)) return 100.0;
  if (error <= 0.0) return 0.0;
  return std::clamp(100.0 * (std::log10(error / tolerance) + 3.0) / 9.0, 0.0, 100.0);
}

std::string error_cell(const ExamRow& row, const ExamCase& exam, std::size_t i) {
  return format_text("<td%s>%s<span class=\"bar\"><i style=\"width:%.0f%%\"></i></span></td>",
                     row.within[i] ? " class=\"within\"" : "",
                     std::isfinite(row.errors[i]) ? format_text("%.2e", row.errors[i]).c_str()
                                                  : xml_text(row.status).c_str(),
                     bar_length(row.errors[i], exam.quantities[i].tolerance));
}

std::string table(const ExamOutcome& outcome) {
  const ExamCase& exam = outcome.exam;
  std::string html = "<div class=\"scroll\"><table><thead><tr><th>method<th>parameter<th>sub-steps";
  for (const ExamQuantity& quantity : exam.quantities) {
    html += format_text("<th>%s [%s]<br>&le; %.2g", xml_text(quantity.name).c_str(),
                        xml_text(quantity.unit).c_str(), quantity.tolerance);
  }
  html += "<th>order<th>time [s]</thead><tbody>\n";
  for (const ExamRow& row : outcome.result.rows) {
    html +=
        format_text("<tr%s><td>%s<td>%s %g<td>%.1f", row.keeps ? "" : " class=\"broken\"",
                    xml_text(row.method).c_str(), row.parameter.c_str(), row.value, row.substeps);
    for (std::size_t i = 0; i < row.errors.size(); ++i) html += error_cell(row, exam, i);
    html += row.order ? format_text("<td>%.2f", *row.order) : "<td>&ndash;";
    if (row.expected_order) html += format_text(" of %g", *row.expected_order);
    html += format_text("<td>%.2f\n", row.seconds);
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string exam_page(const std::vector<ExamOutcome>& outcomes) {
  std::string html = kExamHead;
  html += "<div class=\"scroll\"><table><thead><tr><th>case<th>verdict</thead><tbody>\n";
  for (const ExamOutcome& outcome : outcomes) {
    html += "<tr><td><a href=\"#" + outcome.entry->name + "\">" + xml_text(outcome.entry->title) +
            "</a><td>" + css_class(outcome) + "\n";
  }
  html += "</tbody></table></div>\n";
  for (const ExamOutcome& outcome : outcomes) {
    html += std::string("<section class=\"claim ") + css_class(outcome) + "\" id=\"" +
            outcome.entry->name + "\">\n<h2>" + xml_text(outcome.entry->title) + "</h2>\n";
    html += "<p>" + xml_text(outcome.exam.definition) + "</p>\n<p class=\"note\">From " +
            xml_text(outcome.exam.source) + ".</p>\n" + table(outcome) + "<ul>\n";
    for (const ExamQuantity& quantity : outcome.exam.quantities) {
      html += "<li>" + xml_text(quantity.name + ": " + quantity.why) +
              (quantity.for_every_run ? "; required of every run" : "") + "\n";
    }
    html += "</ul>\n<p class=\"stamp\">" + xml_text(verdict_of(outcome)) + "</p>\n</section>\n";
  }
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace substep::cli
