#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "app/cli/all_methods.hpp"
#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json.hpp"
#include "core/io/recommended_json.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/alpha_search.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/sweep.hpp"
#include "core/model/format_text.hpp"
#include "core/model/names.hpp"
#include "core/model/setting_fields.hpp"
#include "scenes/generator/recommended.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

constexpr int kMostSubsteps = 10000;  // per frame, the limit of the settings

struct RecommendOptions {
  std::string scene;
  std::string of;
  std::string out;
  bool all = false;
  std::optional<double> error;
  std::optional<double> ms;
  std::optional<double> operations;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  LengthFlags length;
};

/// The given limit and the quantity to minimise.
struct Want {
  ErrorAxis error = ErrorAxis::kTrajectory;
  CostAxis cost = CostAxis::kOperations;
  bool error_is_given = true;
  double limit = 1e-3;

  [[nodiscard]] std::optional<RunPoint> best(std::span<const RunPoint> points) const {
    return error_is_given ? cheapest_within(points, limit) : most_exact_within(points, limit);
  }
};

/// @return the reason why runs of the scene do not have this error; empty if they do
std::string why_without(ErrorAxis axis, const Scene& scene) {
  switch (axis) {
    case ErrorAxis::kTrajectory:
      return scene.criteria.track ? "" : "it tracks no body: --of energy";
    case ErrorAxis::kGap:
      return scene.effects.joints ? "" : "it has no joints: --of path, energy or overlap";
    case ErrorAxis::kPenetration:
      return scene.effects.contact ? "" : "it has no contacts: --of path, energy or gap";
    case ErrorAxis::kEnergy:
    case ErrorAxis::kCount:
      break;
  }
  return "";
}

Want want_of(const RecommendOptions& options, const Scene& scene) {
  Want want;
  want.error = value_of<ErrorAxis>(options.of).value_or(first_axis(scene));
  want.limit = options.error.value_or(want.error == ErrorAxis::kEnergy ? 1.0 : 1e-3);
  if (options.ms || options.operations) {
    want.error_is_given = false;
    want.cost = options.ms ? CostAxis::kTime : CostAxis::kOperations;
    want.limit = options.ms ? *options.ms : *options.operations;
  }
  return want;
}

std::string limit_text(const Want& want) {
  if (want.error_is_given) return format_text("%.3g %s", want.limit, unit_of(want.error));
  return format_text(
      want.cost == CostAxis::kTime ? "%.3g ms per frame" : "%.3g operations per frame", want.limit);
}

/// "0.000858 m for 8.69e+04 operations per frame, 0.0266 ms"
std::string figures(const Result& result, ErrorAxis axis) {
  return format_text("%.3g %s for %.3g operations per frame, %.3g ms",
                     error_of(result, axis).value_or(0.0), unit_of(axis),
                     cost_of(result, CostAxis::kOperations), cost_of(result, CostAxis::kTime));
}

void print_alpha(std::FILE* words, const std::shared_ptr<const Scene>& scene, const Want& want,
                 double seconds) {
  Experiment paper = experiment_of(*scene, paper_settings(*scene));
  paper.duration = seconds;
  paper.settings.n_max = kMostSubsteps;  // so that alpha alone determines N
  const Reference reference = find_reference(scene, seconds);
  AlphaSearch search =
      want.error_is_given
          ? AlphaSearch::largest_within(scene, paper, reference, want.error, want.limit)
          : AlphaSearch::smallest_within(scene, paper, reference, want.cost, want.limit);
  while (search.advance(0.1)) {
    if (cancel_on_signal()) return;
  }
  const std::optional<AlphaChoice>& choice = search.choice();
  const char* which = want.error_is_given ? "largest" : "smallest";
  if (!choice) {
    std::fprintf(words, "The paper's method: no alpha from %g to 1 meets the limit.\n",
                 AlphaSearch::kLeast);
    return;
  }
  std::fprintf(words, "The paper's method: the %s alpha that meets the limit is %.3g, %s\n", which,
               choice->alpha, figures(choice->result, want.error).c_str());
}

int recommend(const RecommendOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return kBadInput;
  const Want want = want_of(options, *scene);
  if (const std::string why = why_without(want.error, *scene); !why.empty()) {
    complain("%s has no %s; %s", scene->name.c_str(), axis_name(want.error), why.c_str());
    return kBadInput;
  }

  const double seconds = static_cast<double>(options.length.count(*scene)) * scene->frame;
  const auto swept = run_all_methods(scene, seconds, options.jobs);
  if (!swept) return kCancelled;
  const std::vector<Result>& results = *swept;

  const std::vector<RunPoint> points = run_points(results, want.error, want.cost);
  // If the scene goes to standard output, messages go to stderr.
  std::FILE* words = is_standard_output(options.out) ? stderr : stdout;
  std::fprintf(words, "%s: %zu of %zu runs hold. Error: %s.\n", scene->name.c_str(), points.size(),
               results.size(), axis_name(want.error));
  if (points.empty()) return kUnexpectedVerdict;
  const auto best = want.best(points);
  if (best) {
    const Result& result = results[best->result];
    const SeriesParameter parameter = series_parameter(result.experiment.settings);
    std::fprintf(words, "%s within %s: %s, %s = %g: %s\n",
                 want.error_is_given ? "The cheapest" : "The most accurate",
                 limit_text(want).c_str(), series_name(result.experiment.settings).c_str(),
                 parameter.name, parameter.value, figures(result, want.error).c_str());
    std::fprintf(words, "  substep run %s%s\n", options.scene.c_str(),
                 setting_flags(result.experiment.settings, scene->settings).c_str());
  } else {
    std::fprintf(words, "No method meets %s.\n", limit_text(want).c_str());
  }
  if (best && !options.out.empty()) {
    const auto recommended = recommended_of(results, want.error, want.limit);
    // The output may be the file that the scene was read from.
    const Scene with = with_recommended(*scene, *recommended);
    if (!write_file(options.out, write_scene(with))) return kBadInput;
  }
  print_alpha(words, scene, want, seconds);
  if (cancel_on_signal()) return kCancelled;
  return best ? kOk : kUnexpectedVerdict;
}

/// Sweeps the shipped scenes and writes the recommended settings for each, within its required
/// error: scenes/generator/recommended.json. @return exit code
int recommend_shipped(const std::string& out, int jobs) {
  int exit_code = kOk;
  Json all = Json::object();
  for (const Scene& scene : scenes::shipped()) {
    const scenes::Wanted* wanted = scenes::wanted_of(scene.name);
    if (wanted == nullptr) continue;
    const auto results =
        run_all_methods(std::make_shared<const Scene>(scene), wanted->seconds, jobs);
    if (!results) return kCancelled;
    const auto recommended = recommended_of(*results, wanted->of, wanted->within);
    if (!recommended) {
      complain("%s: no method meets %g %s", wanted->scene, wanted->within, unit_of(wanted->of));
      exit_code = kUnexpectedVerdict;
      continue;
    }
    const SeriesParameter parameter = series_parameter(recommended->settings);
    complain("%s: %s, %s = %g", wanted->scene, series_name(recommended->settings).c_str(),
             parameter.name, parameter.value);
    all[wanted->scene] = recommended_json(*recommended);
  }
  return write_file(out, json_file(all)) ? exit_code : kBadInput;
}

}  // namespace

void add_recommend(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RecommendOptions>();
  CLI::App* command = app.add_subcommand("recommend",
                                         "Run all methods on a scene and print the cheapest within "
                                         "an error, or the most accurate within a cost");
  CLI::Option* scene =
      command->add_option("scene", options->scene, "name or file of a scene, - for standard input");
  const CLI::Validator positive = within(1e-15, 1e15);
  CLI::Option* error = command
                           ->add_option("--error", options->error,
                                        "largest permitted error [m, J]; default 1 mm, 1 J")
                           ->check(positive);
  CLI::Option* of =
      command
          ->add_option("--of", options->of,
                       "error of: path (of the body that the scene tracks), energy, gap or overlap")
          ->check(among({"path", "energy", "gap", "overlap"}));
  CLI::Option* ms =
      command->add_option("--ms", options->ms, "maximum of the median time per frame [ms]")
          ->check(positive)
          ->excludes(error);
  CLI::Option* operations =
      command
          ->add_option("--operations", options->operations,
                       "maximum of solver operations per frame: the same on every machine")
          ->check(positive)
          ->excludes(error)
          ->excludes(ms);
  CLI::Option* out =
      command
          ->add_option("--out", options->out,
                       "write the scene with the recommended settings to this file, - for stdout; "
                       "it starts with them unless it has its own settings")
          ->check(named());
  out->excludes(ms)->excludes(operations);
  command
      ->add_flag(
          "--all", options->all,
          "the recommended settings of all shipped scenes, as JSON to --out or stdout (minutes)")
      ->excludes(scene)
      ->excludes(error)
      ->excludes(of)
      ->excludes(ms)
      ->excludes(operations);
  command->add_option("--jobs", options->jobs, "threads")->check(whole(1, 1024));
  options->length.add_to(*command);
  command->footer(
      "For comparison, it prints the paper's method with the largest alpha within the error, or\n"
      "the smallest within the cost, found by bisection over whole runs. Exit code 1 if no\n"
      "method meets the limit.\n"
      "Examples:\n"
      "  substep recommend swinging_box --error 1e-4\n"
      "  substep recommend bridge --of gap --error 1e-3\n"
      "  substep recommend swinging_box --ms 0.05\n"
      "  substep recommend my_scene.json --error 1e-3 --out my_scene.json");
  command->callback([options, &exit_code] {
    if (options->all) {
      if (options->length.seconds || options->length.frames) {
        throw CLI::ValidationError("--all", "each shipped scene has its own duration");
      }
      exit_code = recommend_shipped(options->out.empty() ? "-" : options->out, options->jobs);
      return;
    }
    if (options->scene.empty()) throw CLI::RequiredError("scene or --all");
    exit_code = recommend(*options);
  });
}

}  // namespace substep::cli
