#include "app/cli/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/run_report.hpp"
#include "app/cli/run_trace.hpp"
#include "app/report/page.hpp"
#include "core/io/experiment.hpp"
#include "core/io/result.hpp"
#include "core/lab/energy_scale.hpp"
#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"

namespace substep::cli {
namespace {

namespace fs = std::filesystem;

/// As many digits as a picture needs, fewer than 17.
double shortened(double x) { return parse_number(format_text("%.6g", x)).value_or(0.0); }

/// The settings of a result; empty if the line is of another version.
std::optional<Experiment> experiment_in(const Json& result,
                                        const std::shared_ptr<const Scene>& scene) {
  Json json = result;
  for (const char* other : {"series", "parameter", "holds", "failed_at", "verdict", "hash",
                            "errors", "reference", "work", "timing", "command"}) {
    json.erase(other);
  }
  Problems problems;
  return read_experiment(
             json, [&](const std::string&) { return scene; }, problems)
      .experiment;
}

/// The cost of stages, rows, effects and the criterion, with each solver.
Json costs_of(const Scene& scene) {
  constexpr double kSeconds = 2.0;  // enough frames for a mean
  Json list = Json::array();
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    Settings settings = own_settings(scene);
    settings.solver = solver;
    settings.drift = Drift::kAuto;
    Experiment experiment = experiment_of(scene, settings);
    experiment.duration = std::min(kSeconds, scene.criteria.duration);
    Json costs = costs_json(cost_of_effects(scene, experiment));
    costs["series"] = series_name(settings);
    list.push_back(std::move(costs));
  }
  return list;
}

Json time_charts(const std::shared_ptr<const Scene>& scene, const std::vector<Json>& results) {
  int least = 0;  // smallest stable constant N
  for (const Json& result : results) {
    const Json& parameter = result["parameter"];
    if (result.value("series", "") != "bpp, const, euler" || !result.value("holds", false) ||
        result.value("load", 1.0) != 1.0) {
      continue;
    }
    const int n = static_cast<int>(parameter.value("value", 0.0));
    if (least == 0 || n < least) least = n;
  }
  Settings settings = own_settings(*scene);
  settings.solver = SolverKind::kBpp;
  settings.integrator = Integrator::kEuler;
  settings.drift = Drift::kAuto;
  std::vector<Curve> n_curves;
  std::vector<Curve> energy_curves;
  const auto add = [&](const std::string& name, bool with_n) {
    const RunTrace trace = trace_run(scene, settings, scene->criteria.duration);
    const std::string note = trace.holds ? "" : trace.verdict;
    if (with_n) {
      n_curves.push_back({name,
                          {trace.time.begin() + 1, trace.time.end()},
                          {trace.substeps.begin() + 1, trace.substeps.end()},
                          note,
                          !trace.holds,
                          settings.mode == Mode::kConst,
                          true});
    }
    energy_curves.push_back({name, trace.time, trace.kinetic, note, !trace.holds});
  };
  settings.mode = Mode::kAdaptive;
  add("adaptive, alpha " + number_text(settings.alpha), true);
  settings.mode = Mode::kConst;
  settings.n = least;
  if (least > 0) add("constant " + std::to_string(least) + ", the smallest that holds", true);
  settings.mode = Mode::kDamping;
  add("damping", false);
  settings.mode = Mode::kNone;
  add("none", false);
  Json charts = Json::array();
  charts.push_back(chart_json("Sub-steps over time",
                              "Adaptive sub-steps follow the forces. A constant number must be "
                              "found by trial for the worst frame, and again for every scene.",
                              "time [s]", "sub-steps per frame", false, n_curves));
  charts.push_back(chart_json("Kinetic energy over time",
                              "A mode that loses or gains energy deviates from the others.",
                              "time [s]", "kinetic energy [J]", false, energy_curves));
  return charts;
}

}  // namespace

Json chart_json(const std::string& title, const std::string& note, const std::string& x,
                const std::string& y, bool log, const std::vector<Curve>& curves) {
  constexpr std::size_t kMostPoints = 1500;  // per curve; more than the pixels
  Json json{{"title", title}, {"note", note}, {"x", x}, {"y", y}, {"log", log}};
  Json& list = json["curves"] = Json::array();
  for (const Curve& curve : curves) {
    Json one{{"name", curve.name}, {"dashed", curve.dashed}, {"step", curve.step}};
    if (!curve.note.empty()) one["note"] = curve.note;
    if (curve.failed) one["failed_at"] = curve.x.empty() ? 0.0 : curve.x.back();
    Json& points = one["points"] = Json::array();
    // Minimum and maximum of each interval, in the order of time, so that peaks are kept.
    const std::size_t n = curve.x.size();
    const std::size_t stretch = std::max<std::size_t>(1, 2 * n / kMostPoints);
    for (std::size_t i = 0; i < n; i += stretch) {
      const auto first = curve.y.begin() + static_cast<std::ptrdiff_t>(i);
      const auto last = curve.y.begin() + static_cast<std::ptrdiff_t>(std::min(n, i + stretch));
      const auto [low, high] = std::minmax_element(first, last);
      auto a = static_cast<std::size_t>(low - curve.y.begin());
      auto b = static_cast<std::size_t>(high - curve.y.begin());
      if (a > b) std::swap(a, b);
      points.push_back({shortened(curve.x[a]), shortened(curve.y[a])});
      if (b != a) points.push_back({shortened(curve.x[b]), shortened(curve.y[b])});
    }
    list.push_back(std::move(one));
  }
  return json;
}

bool write_page(const fs::path& path, const Json& data, bool quiet) {
  if (report::kHead.empty()) {
    complain("%s: not written, this program was built without Node.js and the chart library",
             path.string().c_str());
    return true;  // the results themselves are written
  }
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  // The data must not close the element that contains them.
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  std::string page(report::kHead);
  page += text;
  page += report::kTail;
  if (!write_file(path.string(), page)) return false;
  if (!quiet) say(stdout, "report   %s\n", visible_text(path.string()).c_str());
  return true;
}

bool write_sweep_report(const fs::path& folder, const std::shared_ptr<const Scene>& scene,
                        const std::vector<Json>& results, bool quiet) {
  Json data;
  const std::string name = results.empty() ? "" : results.front().value("scene", "");
  data["title"] = "Cost of accuracy: " + (scene ? scene->title : name);
  Json about = Json::array();
  if (scene) about.push_back(scene->description + " " + scene->look_for);
  Json own = Json::array();
  std::size_t failed = 0;
  for (const Json& result : results) {
    failed += result.value("holds", true) ? 0U : 1U;
    Json& one = own.emplace_back(result);
    one.erase("settings");  // redundant with the command, which is shorter
    if (!scene) continue;
    if (const auto experiment = experiment_in(result, scene)) {
      one["command"] = command_line(*experiment, *scene);
    }
    if (!data.contains("reference") && result.value("load", 1.0) == 1.0) {
      data["reference"] = result["reference"];
    }
  }
  about.push_back(std::to_string(results.size()) + " runs, " + std::to_string(failed) +
                  " of them failed; they are included.");
  if (data.contains("reference")) {
    const Json& reference = data["reference"];
    const auto number = [&](const char* field) {  // null: it is not finite
      const Json& value = reference[field];
      return value.is_number() ? value.get<double>() : std::numeric_limits<double>::infinity();
    };
    std::string line =
        format_text("Errors are measured from: %s, uncertain by %.2g m, over %g s.",
                    reference.value("source", "").c_str(), number("uncertainty"), number("window"));
    const double scale = number("energy_scale");
    if (std::isfinite(scale) && scale >= kLeastEnergyScale) {
      line += format_text(" 100 %% energy drift is %g J, %s.", scale,
                          reference.value("energy_scale_source", "").c_str());
    }
    about.push_back(line);
  }
  data["about"] = std::move(about);
  data["results"] = std::move(own);
  if (scene) {
    data["mass_ratio"] = mass_ratio(*scene);
    data["charts"] = time_charts(scene, results);
    data["costs"] = costs_of(*scene);
    data["settings"] = Json::array(
        {"The scene's own settings: " + settings_line(scene->settings) +
             ". Runs differ from them only by method and parameter.",
         "Work (sub-steps, row updates, operations) is counted and the same on every "
         "machine. Times are of the machine of the sweep, without the first ten frames of a run; "
         "parallel runs share it. Energies with another load are relative to the load."});
  }
  return write_page(folder / "report.html", data, quiet);
}

}  // namespace substep::cli
