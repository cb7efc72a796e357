#include "core/io/diagnosis_html.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/io/xml_text.hpp"
#include "core/lab/doctor_words.hpp"
#include "core/model/format_text.hpp"
#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

constexpr const char* kReportStyle = R"(<style>
:root { color-scheme: light; --ground: #ffffff; --well: #f4f6f9; --border: #d5dbe4; --text: #161b24;
  --dim: #556072; --orange: #b8400a; --teal: #0b7a5e; --amber: #8a5a00; }
@media (prefers-color-scheme: dark) { :root { color-scheme: dark; --ground: #14181f; --well: #1b2029;
  --border: #343c4a; --text: #e8ecf2; --dim: #9aa4b3; --orange: #ff8a4c; --teal: #46c6a0;
  --amber: #f0b64a; } }
body { margin: 0; background: var(--ground); color: var(--text);
  font: 15px/1.5 Inter, system-ui, sans-serif; }
main { max-width: 960px; margin: 0 auto; padding: 24px 20px 64px; }
h1 { font-size: 24px; font-weight: 600; margin: 0 0 12px; overflow-wrap: anywhere; }
h2 { font-size: 18px; font-weight: 600; margin: 32px 0 4px; }
p, li { max-width: 76ch; overflow-wrap: anywhere; }
.answer { border-left: 4px solid var(--teal); padding: 4px 0 4px 16px; font-size: 18px; }
.answer.fails { border-color: var(--orange); }
.answer.holds.narrowly { border-color: var(--amber); }
.dim { color: var(--dim); font-size: 13px; }
.fault { color: var(--orange); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 5px 14px 5px 0; border-bottom: 1px solid var(--border);
  font-weight: 400; vertical-align: top; }
thead th { color: var(--dim); }
td.number, th.number { text-align: right; white-space: nowrap; }
code { background: var(--well); padding: 1px 4px; border-radius: 4px; }
</style>
)";

/// A table whose cells are text, not HTML. The first column and those of words are on the left.
class HtmlTable {
 public:
  explicit HtmlTable(std::vector<std::pair<std::string, bool>> columns)
      : columns_(std::move(columns)) {
    html_ = "<div class=\"scroll\"><table><thead>";
    row(names(), "th");
    html_ += "</thead><tbody>";
  }
  void add(const std::vector<std::string>& cells) { row(cells, "td"); }
  [[nodiscard]] std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& column : columns_) names.push_back(column.first);
    return names;
  }
  void row(const std::vector<std::string>& cells, const std::string& tag) {
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      html_ += "<" + tag + (columns_[i].second ? " class=\"number\">" : ">");
      html_ += xml_text(cells[i]) + "</" + tag + ">";
    }
    html_ += "</tr>\n";
  }

  std::vector<std::pair<std::string, bool>> columns_;  // name, and whether they are numbers
  std::string html_;
};

std::string drives_html(const Scene& scene, const Diagnosis& d) {
  const bool held = d.question.held > 0;
  std::vector<std::pair<std::string, bool>> columns = {{"joint", false},
                                                       {"inertia", true},
                                                       {"armature to add", true},
                                                       {"all explicit", true},
                                                       {"damping implicit", true}};
  if (held) columns.insert(columns.end(), {{"held", true}, {"by delay", true}});
  HtmlTable table(std::move(columns));
  for (const DriveLimit& drive : d.drives) {
    const Joint& joint = scene.joints[index(drive.joint)];
    const auto axes = axes_of(joint);
    const char* unit = axes && axes->slides ? " kg" : " kg m²";
    std::vector<std::string> cells = {base(joint).name, format_text("%.3g", drive.inertia) + unit,
                                      format_text("%.3g", drive.armature) + unit,
                                      step_text(drive.explicit_step), step_text(drive.damped_step)};
    if (held) {
      cells.push_back(step_text(drive.held_step));
      cells.push_back(step_text(drive.delay_step));
    }
    table.add(cells);
  }
  return "<h2>Drives and springs: largest steps</h2>\n" + table.html();
}

std::string groups_html(const Scene& scene, const Diagnosis& d) {
  HtmlTable table({{"group of", false},
                   {"bodies", true},
                   {"freedom", true},
                   {"largest step", true},
                   {"geometric stiffness alone", true},
                   {"the paper’s criterion", true}});
  for (const GroupLimit& limit : d.start) {
    const GroupFacts& group = d.groups[limit.group];
    table.add({scene.bodies[index(group.bodies[0])].name, std::to_string(group.bodies.size()),
               std::to_string(group.freedom), step_text(limit.step), step_text(limit.geometric),
               step_text(limit.criterion)});
  }
  return "<h2>Groups of joined bodies, at the start</h2>\n" + table.html();
}

std::string runs_html(const Diagnosis& d) {
  HtmlTable table({{"run", false}, {"length", true}, {"verdict", false}});
  for (const DoctorRun& run : d.runs) {
    table.add(
        {run.what + ", with adaptive sub-steps", format_text("%g s", run.seconds), run.verdict});
  }
  if (d.at_step) {
    const std::string why = disagreement_of(d);
    table.add({d.at_step->what, format_text("%g s", d.at_step->seconds),
               d.at_step->verdict + (why.empty() ? "" : ". " + why)});
  }
  return "<h2>Runs</h2>\n" + table.html();
}

std::string remedies_html(const Diagnosis& d) {
  HtmlTable table({{"change", false}, {"verdict", false}, {"work", true}, {"off by", true}});
  for (const TriedRemedy& tried : d.remedies) {
    table.add({tried.text, tried.verdict, format_text("%.2g times", tried.cost),
               format_text("%.2g m", tried.moved)});
  }
  return format_text(
             "<h2>Remedies</h2>\n<p class=\"dim\">Tried for %g s after the shake. Work: operations "
             "of the solver per second, relative to the asked step. Off by: distance from a fine "
             "run in the first second.</p>\n",
             d.question.seconds) +
         table.html();
}

std::string settings_html(const Scene& scene, const Diagnosis& d) {
  HtmlTable table({{"engine", false}, {"setting", false}, {"", false}});
  for (const EngineSetting& setting : engine_settings(scene, d)) {
    table.add({setting.engine->title, setting.text,
               setting.assumed ? "its treatment of drives is assumed" : ""});
  }
  return format_text("<h2>Settings, at least, with a margin of %g</h2>\n", kSafeMargin) +
         table.html();
}

}  // namespace

std::string diagnosis_html(const Scene& scene, const Diagnosis& d) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>Step of " +
      xml_text(scene.name) + "</title>\n" + kReportStyle + "</head>\n<body>\n<main>\n<h1>" +
      xml_text(scene.name) + "</h1>\n<p class=\"answer " + word_of(d.verdict) + "\">A step of " +
      step_text(d.question.step) + " " + word_of(d.verdict) + ".<br>" + xml_text(summary_of(d)) +
      ".</p>\n";
  if (d.question.held > 0) {
    html += format_text("<p>Drives are laws outside the engine, held over %d steps.</p>\n",
                        d.question.held);
  }
  if (d.too_large > 0) {
    html += format_text("<p>%d bodies are in groups of more than %d and were not analysed.</p>\n",
                        d.too_large, LinearModel::kMostBodies);
  }
  if (!d.findings.empty()) {
    html += "<h2>Findings</h2>\n<ul>\n";
    for (const Finding& finding : d.findings) {
      html += std::string(finding.fails ? "<li class=\"fault\">Fault: " : "<li>Warning: ") +
              xml_text(finding.text) + "</li>\n";
    }
    html += "</ul>\n";
  }
  if (!d.start.empty()) html += groups_html(scene, d);
  if (!d.drives.empty()) html += drives_html(scene, d);
  if (!d.runs.empty() || d.at_step) html += runs_html(d);
  if (!d.remedies.empty()) html += remedies_html(d);
  if (std::isfinite(d.step)) html += settings_html(scene, d);
  return html +
         "<p class=\"dim\">The largest step is that of the linearised model with constraint forces "
         "frozen: exact for a model at rest, a bound in motion. Contacts are in the runs alone. "
         "Made by <code>substep doctor</code>.</p>\n</main>\n</body>\n</html>\n";
}

std::string diagnosis_badge(const Diagnosis& d) {
  constexpr double kBadgeLetter = 6.6;   // mean width of a letter at 11 px [px]
  constexpr double kBadgePadding = 8.0;  // [px]
  const std::string value =
      std::isfinite(d.step) ? "below " + step_text(d.step) : std::string("no limit");
  const std::string label = std::string(d.question.engine->title) + " step";
  const char* color = "#4b5563";
  if (d.verdict == Diagnosis::Verdict::kHolds) color = "#0b7a5e";
  if (d.verdict == Diagnosis::Verdict::kHoldsNarrowly) color = "#8a5a00";
  if (d.verdict == Diagnosis::Verdict::kFails) color = "#b8400a";
  const double left = kBadgeLetter * static_cast<double>(label.size());
  const double right = kBadgeLetter * static_cast<double>(value.size());
  const double split = left + 2.0 * kBadgePadding;
  const double width = split + right + 2.0 * kBadgePadding;
  const std::string title =
      xml_text(label + ": " + value + ", " + step_text(d.question.step) + " " + word_of(d.verdict));
  std::string svg = format_text(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"20\" role=\"img\">"
      "<title>%s</title><rect width=\"%.0f\" height=\"20\" rx=\"3\" fill=\"#333a45\"/>",
      width, title.c_str(), width);
  svg += format_text("<path d=\"M%.0f 0H%.0fa3 3 0 0 1 3 3v14a3 3 0 0 1 -3 3H%.0fz\" fill=\"%s\"/>",
                     split, width - 3.0, split, color);
  const auto text = [&](double x, double length, const std::string& of) {
    svg += format_text("<text x=\"%.0f\" y=\"14\" textLength=\"%.0f\">", x, length) + xml_text(of) +
           "</text>";
  };
  svg += "<g fill=\"#fff\" font-family=\"Verdana,DejaVu Sans,sans-serif\" font-size=\"11\">";
  text(kBadgePadding, left, label);
  text(split + kBadgePadding, right, value);
  return svg + "</g></svg>\n";
}

}  // namespace substep
